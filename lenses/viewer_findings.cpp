#include "lenses/viewer_findings.hpp"

#include <cmath>
#include <cstdio>

#include "lenses/engine.hpp"
#include "lenses/lens_model.hpp"
#include "lenses/trace.hpp"

namespace lenses {
namespace {

constexpr double kMostBlur = 0.25;            // D
constexpr double kPresbyope = 45.0;           // years
constexpr double kMostDistanceError = 0.001;  // m
constexpr double kMostVerticalPrism = 1.0;    // prism dioptres

constexpr std::array kSides{Side::right, Side::left};
constexpr std::array kSideNames{"right", "left"};

template <class... Values>
std::string text(const char* format, Values... values) {
  char out[400];
  static_cast<void>(std::snprintf(out, sizeof out, format, values...));
  return out;
}

// The residual's greater principal value by magnitude.
double worst_meridian(const glm::dvec3& residual) {
  const glm::dvec3 principal = f64::principal(residual);
  return std::abs(principal.x) > std::abs(principal.y) ? principal.x : principal.y;
}

Finding own_blur(Side side, const Viewer& viewer, const HeadsetDisplay& headset, double worst) {
  const bool corrected = viewer.worn_in_headset != Viewer::Worn::nothing;
  const std::string cause =
      corrected ? "the display is nearer than the eye can focus" : "nothing corrects it inside the headset";
  return {"own_blur", side, worst, "D",
          text("the viewer's own %s eye is %.2f D off the display at %.2f m, as %s; no picture can sharpen that",
               kSideNames[static_cast<std::size_t>(side)], std::abs(worst), headset.focal_distance, cause.c_str())};
}

}  // namespace

glm::dvec3 viewer_residual(const Viewer& viewer, double age, double focal_distance) {
  Eye eye;
  if (viewer.worn_in_headset == Viewer::Worn::nothing) {
    eye.power = viewer.refraction;
  }
  const double amplitude = viewer.accommodation_amplitude.value_or(accommodation_amplitude_at(age));
  const f64::EyeData data = make_eye_data(eye, amplitude, kDefaultPupilDiameter);
  const glm::dvec3 vergence(-1.0 / focal_distance, 0.0, -1.0 / focal_distance);
  return f64::eye_response(vergence, data, f64::clamped_accommodation(vergence, data)).residual;
}

std::vector<Finding> viewer_findings(const Wearer& wearer, const HeadsetDisplay& headset) {
  std::vector<Finding> findings;
  const double age = wearer.viewer_age.value_or(wearer.age);
  bool anyone = wearer.viewer_age.has_value();
  for (const Side side : kSides) {
    const auto& viewer = wearer.viewer[static_cast<std::size_t>(side)];
    if (!viewer) {
      continue;
    }
    anyone = true;
    const double worst = worst_meridian(viewer_residual(*viewer, age, headset.focal_distance));
    if (std::abs(worst) > kMostBlur) {
      findings.push_back(own_blur(side, *viewer, headset, worst));
    }
  }
  if (anyone && age < kPresbyope) {
    findings.push_back({"convergence", std::nullopt, age, "years",
                        text("at %.0f years, converging on near objects may pull the viewer's own focus off the "
                             "display's plane at %.2f m",
                             age, headset.focal_distance)});
  }
  return findings;
}

std::optional<Finding> distance_finding(const Wearer& wearer, double headset_distance,
                                        const std::array<double, 2>& horizontal_power) {
  const double own = wearer.pupillary_distance[0] + wearer.pupillary_distance[1];
  const double difference = headset_distance - own;
  if (!(std::abs(difference) > kMostDistanceError)) {
    return std::nullopt;
  }
  // Half of it at each eye: Prentice, centimetres times dioptres. Pupils farther apart than the lenses' centres look
  // through a plus lens's outer part, whose base is in.
  const double prism = 0.5 * 100.0 * difference * (horizontal_power[0] + horizontal_power[1]);
  return Finding{
      "pupillary_distance", std::nullopt, 1e3 * difference, "mm",
      text("the headset's lenses are %.1f mm apart, the wearer's pupils %.1f mm: %.2f prism dioptres base %s "
           "for the pair",
           1e3 * headset_distance, 1e3 * own, std::abs(prism), prism < 0.0 ? "out" : "in")};
}

double vertical_prism(const SightDirections& sight) {
  const auto elevation = [](const glm::dvec3& d) { return std::atan2(d.y, std::hypot(d.x, d.z)); };
  return 100.0 * std::tan(elevation(sight.object) - elevation(sight.gaze));
}

std::optional<Finding> vertical_prism_finding(const std::array<SightDirections, 2>& sight) {
  const double right = vertical_prism(sight[0]), left = vertical_prism(sight[1]);
  const double difference = right - left;
  if (!(std::abs(difference) > kMostVerticalPrism)) {
    return std::nullopt;
  }
  return Finding{"vertical_prism", std::nullopt, difference, "pd",
                 text("the lenses' vertical prisms differ by %.2f prism dioptres here (right %.2f, left %.2f base up); "
                      "more than 1 strains and may double the picture",
                      std::abs(difference), right, left)};
}

}  // namespace lenses
