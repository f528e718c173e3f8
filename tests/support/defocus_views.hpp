// The views that approximate defocus is judged by. Their references are distributed rays, in
// tests/golden/references/defocus; adof_views_test remakes them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <ostream>
#include <span>

#include "render/image/exr.hpp"
#include "tests/support/defocus_scene.hpp"

namespace support {

inline constexpr int kDefocusSize = 192;  // pixels a side
// What blur brings in from outside a picture no neighbour can tell: pixels nearer to its border than the largest blur
// of the views (14 px) are not judged.
inline constexpr int kDefocusMargin = 16;

struct DefocusView {
  const char* name;
  const char* scene;       // room, layers, lamps
  const char* wearer;      // of assets/wearers, or empty: 62 years old and emmetropic
  double sphere;           // D, refraction in place of the wearer's own; 0: as the file says
  double age;              // years
  const char* spectacles;  // of assets/spectacles, or empty: none
  const char* target;
  std::array<double, 2> aside_deg;  // the picture's centre, right of and above the target
  double fov_deg;
  double least_db;            // that approximate defocus reaches against the reference
  double head_yaw_deg = 0.0;  // turned to the right, the gaze staying on the target

  friend std::ostream& operator<<(std::ostream& out, const DefocusView& view) { return out << view.name; }
};

inline constexpr std::array kDefocusViews{
    DefocusView{"text_near", "room", "presbyopia", 0, 62, "", "near_card", {1.5, 0}, 6, 50},
    DefocusView{"text_far", "room", "emmetropia", -3.0, 35, "", "etdrs_chart", {0, 0.5}, 4.5, 50},
    DefocusView{"clock_dial", "room", "astigmatism", 0, 35, "", "clock_dial", {0, 0}, 4.5, 50},
    DefocusView{
        "progressive_rim", "room", "presbyopia", 0, 62, "presbyopia_bspline_sphere", "window", {-2, 1}, 7.5, 38, 12},
    DefocusView{
        "progressive_corridor", "room", "presbyopia", 0, 62, "presbyopia_bspline_sphere", "screen", {2, 0}, 6, 45},
    DefocusView{"blurred_before_sharp", "layers", "emmetropia", 0, 20, "", "far", {0, 0}, 3.75, 36},
    DefocusView{"sharp_before_blurred", "layers", "emmetropia", 0, 20, "", "near", {0, 0}, 3.75, 35.5},
    DefocusView{"both_blurred", "layers", "presbyopia", -1.5, 62, "", "far", {0, 0}, 3, 36.5},
    DefocusView{"lamps", "lamps", "emmetropia", 0, 20, "", "near", {0, 0}, 3, 40},
    DefocusView{"minus_lens", "room", "myopia", 0, 62, "myopia", "phone", {0, 0}, 10.5, 49},
    DefocusView{"plus_lens", "room", "hyperopia", 0, 62, "hyperopia", "near_card", {-1, 1.5}, 7.5, 49},
    DefocusView{"reading_room", "room", "presbyopia", -2.5, 62, "", "screen", {9, 12}, 13.5, 42},
};

// The scenes above and their renderers, made when first asked for.
class DefocusViews {
 public:
  explicit DefocusViews(render::vk::Device& device) : device_(device) {}

  // The right eye's picture.
  render::RenderedView render(const DefocusView& view, const render::FrameConfig& settings,
                              const render::Progress& progress = {}) {
    return frame(view, settings, progress).views.at(0);
  }

  render::RenderedFrame frame(const DefocusView& view, const render::FrameConfig& settings,
                              const render::Progress& progress = {}) {
    Stage& stage = stage_of(view.scene);
    const WornPair pair = worn(view, stage.scene);
    auto setups = views_at(pair, Viewing::gaze, target_position(stage.scene, view.target),
                           tracking::FieldOfView::symmetric(view.fov_deg * kDegree, 1.0));
    setups[0].view.head_from_view.orientation = setups[0].view.head_from_view.orientation *
                                                glm::angleAxis(-view.aside_deg[0] * kDegree, glm::dvec3(0, 1, 0)) *
                                                glm::angleAxis(view.aside_deg[1] * kDegree, glm::dvec3(1, 0, 0));
    render::FrameConfig config = settings;
    config.width = config.height = kDefocusSize;
    config.keep_radiance = true;
    return stage.renderer.render(pair.model, {setups[0]}, config, progress);
  }

 private:
  static WornPair worn(const DefocusView& view, const render::Scene& scene) {
    lenses::Wearer wearer = lenses::read_wearer(std::string(VERGENCE_ASSETS "/wearers/") + view.wearer + ".json");
    wearer.age = view.age;
    if (view.sphere != 0.0) {
      for (lenses::Eye& eye : wearer.eye) eye.power = lenses::Refraction{view.sphere, 0.0, 0.0};
    }
    std::optional<lenses::Spectacles> spectacles;
    if (view.spectacles[0] != '\0') {
      spectacles = lenses::read_spectacles(std::string(VERGENCE_ASSETS "/spectacles/") + view.spectacles + ".json");
    }
    tracking::Pose head = scene.start_pose().value();
    head.orientation = head.orientation * glm::angleAxis(-view.head_yaw_deg * kDegree, glm::dvec3(0, 1, 0));
    return wear(wearer, spectacles ? &*spectacles : nullptr, head);
  }

  struct Stage {
    render::Scene scene;
    render::Renderer renderer;
    Stage(render::vk::Device& device, render::Scene s) : scene(std::move(s)), renderer(device, scene) {}
  };

  Stage& stage_of(const std::string& name) {
    auto found = stages_.find(name);
    if (found == stages_.end()) {
      found = stages_
                  .emplace(name, std::make_unique<Stage>(device_, name == "room"     ? reading_room()
                                                                  : name == "layers" ? layered_scene()
                                                                                     : lamp_scene()))
                  .first;
    }
    return *found->second;
  }

  render::vk::Device& device_;
  std::map<std::string, std::unique_ptr<Stage>> stages_;
};

// 1 for every pixel that is judged.
inline std::vector<std::uint8_t> defocus_judged() {
  std::vector<std::uint8_t> judged(static_cast<std::size_t>(kDefocusSize * kDefocusSize));
  for (int y = kDefocusMargin; y < kDefocusSize - kDefocusMargin; ++y) {
    for (int x = kDefocusMargin; x < kDefocusSize - kDefocusMargin; ++x) {
      judged[static_cast<std::size_t>(y * kDefocusSize + x)] = 1;
    }
  }
  return judged;
}

// r, g, b a pixel, linear.
inline std::vector<float> read_defocus_reference(const std::filesystem::path& file) {
  const render::FloatImage image = render::read_exr(file);  // channels B, G, R
  std::vector<float> radiance;
  for (std::size_t i = 0; i < image.planes.at(0).size(); ++i) {
    for (const std::size_t channel : {2U, 1U, 0U}) radiance.push_back(image.planes[channel][i]);
  }
  return radiance;
}

inline void write_defocus_reference(const std::filesystem::path& file, const std::vector<float>& radiance) {
  render::FloatImage image{kDefocusSize, kDefocusSize, {"R", "G", "B"}, std::vector<std::vector<float>>(3)};
  for (std::size_t i = 0; i < radiance.size(); ++i) image.planes[i % 3].push_back(radiance[i]);
  render::write_exr(file, image);
}

inline std::filesystem::path defocus_reference(const DefocusView& view) {
  return std::filesystem::path(VERGENCE_TEST_DATA).parent_path() / "golden" / "references" / "defocus" /
         (std::string(view.name) + ".exr");
}

}  // namespace support
