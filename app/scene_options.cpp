#include "app/scene_options.hpp"

#include <string>
#include <vector>

#include "app/option_values.hpp"
#include "render/ladder.hpp"

namespace app {
namespace {

std::vector<std::string> rung_names() {
  std::vector<std::string> names;
  for (const render::Rung& rung : render::ladder()) {
    names.emplace_back(rung.name);
  }
  return names;
}

// One after another, in lines that a terminal holds beside the names of the options.
std::string in_lines(const std::vector<std::string>& names) {
  constexpr std::size_t kLine = 96;
  std::string text;
  std::size_t line = 0;
  for (const std::string& name : names) {
    const bool fits = line + name.size() + 2 <= kLine;
    text += text.empty() ? "" : fits ? ", " : ",\n";
    line = fits ? line + name.size() + 2 : name.size();
    text += name;
  }
  return text;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& scene, const SceneHelp& help) {
  add_wearing_options(command, scene, help);
  command.add_option("--fov", scene.fov_deg, "Vertical field of view, degrees")->capture_default_str();
  auto* gaze = command.add_option("--gaze", scene.gaze, "YAW,PITCH in degrees, + right, + up, up to 45 each")
                   ->capture_default_str();
  command.add_option("--look-at", scene.look_at, "A target of the scene by name; the picture is centred on it")
      ->excludes(gaze);
  command.add_option("--pose", scene.pose,
                     "X,Y,Z,YAW,PITCH (m, deg) of the midpoint between the pupils, or a camera of the scene by name\n"
                     "or number [the first camera; without one, before the whole scene]");
}

void add_wearing_options(CLI::App& command, SceneOptions& scene, const SceneHelp& help) {
  command.add_option("--scene", scene.scene, help.scene);
  command.add_option("--wearer", scene.wearer, "Wearer file [35 years, emmetropic]");
  auto* spectacles = command.add_option("--spectacles", scene.spectacles, help.spectacles);
  if (!scene.spectacles.empty()) {
    spectacles->capture_default_str();
  }
  command.add_option("--compare", scene.compare, help.compare);
  command
      .add_option("--viewing", scene.viewing,
                  "fixed: all rays from the primary-gaze pupil; scanning: the eye turns to each pixel; gaze: one\n"
                  "pupil turned to the gaze, one accommodation state")
      ->check(CLI::IsMember({"fixed", "scanning", "gaze"}))
      ->capture_default_str();
  command.add_option("--headset", scene.headset, "Headset file: pixels lie on its virtual image, light sets the pupil");
}

void add_picture_options(CLI::App& command, PictureOptions& picture, const std::string& auto_accuracy) {
  std::vector<std::string> rungs = rung_names();
  if (!auto_accuracy.empty()) {
    rungs.emplace_back("auto");
  }
  command
      .add_option(
          "--accuracy", picture.accuracy,
          (auto_accuracy.empty() ? "Rung of the accuracy ladder" : auto_accuracy) + "; one of\n" + in_lines(rungs))
      ->type_name("RUNG")
      ->check(CLI::IsMember(rungs).description(""))
      ->capture_default_str();
  command.add_option("--threshold", picture.threshold_px, "Blurs with a smaller major semi-axis are not drawn, px")
      ->capture_default_str();
  command.add_flag("--all-effects", picture.all_effects, "Draw every blur, however small");
  command
      .add_option("--output-space", picture.output_space,
                  "display or retina; the effects drawn so far look the same in both")
      ->check(CLI::IsMember({"display", "retina"}))
      ->capture_default_str();
  command
      .add_option("--exposure", picture.exposure,
                  "EV of a .png, fixed for the whole run; an .exr holds radiance as it is")
      ->capture_default_str();
}

void check_picture_options(const PictureOptions& picture) {
  check_range("--threshold", picture.threshold_px, 0.0, 1000.0, "px");
  check_range("--exposure", picture.exposure, -32.0, 32.0, "EV");
}

}  // namespace app
