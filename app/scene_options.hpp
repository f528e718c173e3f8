// The options that commands which show a scene share, under one name and with one meaning.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/render_setup.hpp"

namespace app {

// Who looks through what at what: --scene --wearer --spectacles --compare --viewing --headset --fov --gaze --look-at
// --pose. How many eyes and pixels each command says for itself, and --scene's and the pairs' help if theirs differs.
struct SceneHelp {
  std::string scene = "FILE.gltf or FILE.glb [the built-in reading room]";
  std::string spectacles = "Spectacles file, or none";
  std::string compare = "A second pair: A left, B right of a divider in each eye";
};
void add_scene_options(CLI::App& command, SceneOptions& scene, const SceneHelp& help = {});
// The same without --fov --gaze --look-at --pose, for commands that are told live where eyes and head are.
void add_wearing_options(CLI::App& command, SceneOptions& scene, const SceneHelp& help = {});

// How the picture is made of it.
struct PictureOptions {
  std::string accuracy = "standard";
  double threshold_px = 0.5;
  bool all_effects = false;
  std::string output_space = "display";
  double exposure = 0.0;  // EV

  // In pixels; 0 draws every blur.
  [[nodiscard]] double threshold() const { return all_effects ? 0.0 : threshold_px; }
};
// auto_accuracy: help for an --accuracy that also takes "auto"; empty: it does not.
void add_picture_options(CLI::App& command, PictureOptions& picture, const std::string& auto_accuracy = "");
void check_picture_options(const PictureOptions& picture);

}  // namespace app
