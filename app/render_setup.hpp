// From files and options to what the renderer takes: the wearer behind each pair of spectacles, fixated, with a view
// for every picture.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "lenses/headset.hpp"
#include "lenses/lens.hpp"
#include "lenses/lens_model.hpp"
#include "render/fixation.hpp"
#include "render/scene/scene.hpp"
#include "render/view_setup.hpp"

namespace app {

// The field that a headset's picture fills, for the pupil's size: a circle 60 degrees across.
inline constexpr double kHeadsetField_deg2 = std::numbers::pi * 30.0 * 30.0;

// Options shared by the commands that show a scene.
struct SceneOptions {
  std::string scene;   // empty: the built-in reading room
  std::string wearer;  // empty: 35 years, emmetropic
  std::string spectacles = "none";
  std::vector<std::string> further;  // pairs that can be put on after it
  std::string compare;               // a second pair, empty: none
  bool bare_too = false;             // at last, the wearer without spectacles
  std::string headset;               // empty: a desktop picture
  bool in_headset = false;           // there is one, whether or not a file tells of it
  std::string viewing = "gaze";
  std::string gaze = "0,0";  // yaw, pitch in degrees
  std::string look_at;       // a target's name
  std::string pose;          // x, y, z, yaw, pitch, or a camera; empty: start_pose says
  std::string size = "1024x1024";
  double fov_deg = 60.0;
  std::string eye = "both";
};

// A pair on the wearer's nose, looking at something.
struct WornPair {
  std::string name;
  std::array<render::EyeOptics, 2> eyes;  // indexed by Side
  std::array<std::size_t, 2> lens;        // indices into the model
  glm::dvec3 tint{1.0};
  render::Fixation fixation;
};

struct RenderSetup {
  lenses::Wearer wearer;
  lenses::LensModel lenses;
  std::vector<WornPair> pairs;        // one, or A and B; before a session in the order of its options
  std::vector<tracking::Side> sides;  // the eyes shown, in the picture's order from the left
  std::array<int, 2> size{};
  std::optional<lenses::HeadsetDisplay> headset;
  render::Viewing viewing = render::Viewing::gaze;
  std::vector<render::ViewSetup> views;  // pairs x sides, pair by pair
};

// Where the head stands: --pose, numbers or a camera of the scene; else its first camera; else before the whole scene.
[[nodiscard]] tracking::Pose start_pose(const SceneOptions& options, const render::Scene& scene);

[[nodiscard]] render::Viewing viewing_of(const std::string& name);

// Throws tracking::InputError for whatever the files or options hold that cannot be.
[[nodiscard]] RenderSetup make_render_setup(const SceneOptions& options, const render::Scene& scene);

}  // namespace app
