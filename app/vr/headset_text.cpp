#include "app/vr/headset_text.hpp"

#include <algorithm>

#include "app/notice/panel_place.hpp"
#include "app/option_values.hpp"
#include "lenses/pupil.hpp"
#include "xr/gaze_input.hpp"

namespace app {
namespace {

using tracking::Side;

constexpr double kFarthest_m = 10.0;       // to the eyes as good as infinity, and before any compositor's far plane
constexpr double kSunlitPage_cd_m2 = 1e4;  // white paper outdoors

PlateConfig plate_config() {
  PlateConfig config;
  config.font = built_in_asset("fonts/LiberationSans-Regular.ttf").string();
  config.bold_font = built_in_asset("fonts/LiberationSans-Bold.ttf").string();
  return config;
}

double display_pixels_per_degree(const RenderSetup& setup, bool has_headset_file, const tracking::FieldOfView& fov,
                                 int display_width) {
  return has_headset_file ? setup.headset->pixels_per_degree
                          : pixels_per_degree(display_width, fov.tan_left, fov.tan_right);
}

}  // namespace

DisplayLimits display_limits(const RenderSetup& setup, bool has_headset_file, const tracking::FieldOfView& fov,
                             int image_width, int display_width) {
  DisplayLimits limits;
  limits.headset = setup.headset.value();
  limits.pixels_per_degree = std::min(display_pixels_per_degree(setup, has_headset_file, fov, display_width),
                                      pixels_per_degree(image_width, fov.tan_left, fov.tan_right));
  limits.pupil_diameter = setup.pairs.front().eyes[0].eye.pupil.x;
  limits.sunlit_pupil = lenses::pupil_diameter_in_light(kSunlitPage_cd_m2, kHeadsetField_deg2, true, setup.wearer.age);
  limits.viewer_known = setup.wearer.viewer[0] || setup.wearer.viewer[1];
  return limits;
}

NoticeContent notice_content(const VrWorld& world, const std::vector<PlateLine>& limits) {
  NoticeContent content;
  for (const WornPair& pair : world.setup().pairs) {
    content.pairs.push_back(world.is_clear() ? "clear view" : pair.name);
  }
  content.gaze_source = world.gaze_source();
  content.target = world.target_name();
  content.rung = world.rung_name();
  content.map = world.map_name();
  for (const ViewerFinding& found : world.warnings()) {
    content.warnings.push_back((found.pair.empty() ? "" : found.pair + ": ") + found.finding.message);
  }
  content.limits = limits;
  return content;
}

HeadsetText::HeadsetText(const render::vk::Device& device, const xr::Session& session, const xr::FrameLoop& loop)
    : loop_(loop),
      display_width_(xr::recommended_sizes(session.instance())[0][0]),
      text_(device, session, loop.view_space(), plate_config()) {}

void HeadsetText::see_display(const VrWorld& world, const xr::Frame& frame) {
  const RenderSetup& setup = world.setup();
  const bool has_file = !world.options().scene.headset.empty();
  const tracking::FieldOfView& fov = frame.views[0].fov;
  limits_ = limit_lines(display_limits(setup, has_file, fov, loop_.swapchain(Side::right).width(), display_width_));
  config_ = {.distance = std::min(setup.headset.value().focal_distance, kFarthest_m),
             .letter_angle = letter_angle(display_pixels_per_degree(setup, has_file, fov, display_width_))};
}

void HeadsetText::update(const VrWorld& world, const xr::Frame& frame) {
  if (limits_.empty()) {
    see_display(world, frame);
  }
  const auto lines = notice_.step(xr::seconds(frame.display_time), notice_content(world, limits_));
  if (!lines) {
    return;
  }
  std::array<tracking::EyeView, 2> views;
  for (const std::size_t i : {0U, 1U}) {
    views[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
  }
  text_.write(*lines, views, config_);
}

}  // namespace app
