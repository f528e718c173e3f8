#include "app/notice/display_limits.hpp"

#include <cmath>
#include <numbers>

#include "app/report/text.hpp"

namespace app {
namespace {

// A letter of 20/20 has strokes of one minute of arc (Snellen; ISO 8596), which is decimal 1.0 and logMAR 0.
std::string letter_text(double pixels_per_degree) {
  const double stroke = finest_stroke_arcmin(pixels_per_degree);
  return format("finer than 20/%ld (decimal %s, logMAR %s): one pixel covers %s\u2032", std::lround(20.0 * stroke),
                number(1.0 / stroke, 2).c_str(), signed_number(std::log10(stroke), 2).c_str(),
                number(stroke, 1).c_str());
}

std::string light_text(const DisplayLimits& limits) {
  std::string text = format("brighter than white at %g cd/m\u00b2: no glare", limits.headset.luminance);
  if (limits.sunlit_pupil < limits.pupil_diameter) {
    text += format(", and pupils of %s mm where sunlight leaves %s mm", number(1e3 * limits.pupil_diameter, 1).c_str(),
                   number(1e3 * limits.sunlit_pupil, 1).c_str());
  }
  return text;
}

std::string distance_text(double metres) {
  return metres > 100.0 ? "infinity" : number(metres, 2) + " m";
}

}  // namespace

double pixels_per_degree(int pixels, double tan_one_side, double tan_other_side) {
  return pixels / (tan_one_side + tan_other_side) * std::numbers::pi / 180.0;
}

double finest_stroke_arcmin(double pixels_per_degree) {
  return 60.0 / pixels_per_degree;
}

std::vector<PlateLine> limit_lines(const DisplayLimits& limits) {
  const std::string distance = distance_text(limits.headset.focal_distance);
  std::vector<PlateLine> lines{
      {.text = "This display cannot show", .kind = PlateLine::Kind::heading},
      {"Letters", letter_text(limits.pixels_per_degree)},
      {"Light", light_text(limits)},
      {"Focus", "at any distance but " + distance + " for your own eyes: blur is drawn, near and far"}};
  if (!limits.viewer_known) {
    lines.push_back({"Your eyes", "taken to be sharp at " + distance + ": the wearer file does not describe them"});
  }
  return lines;
}

}  // namespace app
