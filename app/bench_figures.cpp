#include "app/bench_figures.hpp"

#include <algorithm>

#include "app/device.hpp"
#include "app/option_values.hpp"
#include "app/picture.hpp"
#include "app/render_setup.hpp"
#include "render/image/colour_bar.hpp"
#include "render/image/png.hpp"
#include "render/renderer.hpp"

namespace app {
namespace {

using render::Image8;
using render::Mode;

constexpr int kGap = 8;
constexpr render::Rgb kPaper{255, 255, 255}, kInk{20, 20, 20};

const render::MapRange kPowerRange{-1.0, 3.0}, kAstigmatismRange{0.0, 3.0};

void blit(Image8& to, const Image8& from, int x, int y) {
  for (int row = 0; row < from.height; ++row) {
    const auto begin = from.rgb.begin() + 3 * row * from.width;
    std::copy(begin, begin + 3 * from.width, to.rgb.begin() + 3 * ((y + row) * to.width + x));
  }
}

struct Panel {
  std::string caption;
  Image8 image;
};

// Panels side by side on white, a caption under each.
Image8 beside(const std::vector<Panel>& panels) {
  int width = kGap, height = 0;
  for (const Panel& panel : panels) {
    width += panel.image.width + kGap;
    height = std::max(height, panel.image.height);
  }
  constexpr int kScale = 2, kCaption = kScale * render::kLineHeight + kGap;
  Image8 out = render::black_image(width, height + 2 * kGap + kCaption);
  render::fill_rect(out, {0, 0, out.width, out.height}, kPaper);
  int x = kGap;
  for (const Panel& panel : panels) {
    blit(out, panel.image, x, kGap);
    render::draw_text(out, x, 2 * kGap + panel.image.height, kScale, panel.caption, kInk);
    x += panel.image.width + kGap;
  }
  return out;
}

// A map with its colour bar to the right of it.
Image8 with_bar(const Image8& map, const render::MapRange& range, const std::string& title) {
  constexpr int kBar = 96;
  Image8 out = render::black_image(map.width + kBar, map.height);
  blit(out, map, 0, 0);
  render::draw_colour_bar(out, render::colour_bar_place(out), 0, range.low, range.high, "D", title);
  return out;
}

// One scene on the device, drawn with various eyes and lenses.
class Studio {
 public:
  Studio(render::vk::Device& device, const std::string& scene_file)
      : scene_(render::read_gltf(scene_file)),
        renderer_(device, scene_, {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}) {}

  [[nodiscard]] bool has_target(const std::string& name) const {
    return std::ranges::find(scene_.targets, name, &render::Target::name) != scene_.targets.end();
  }

  // Right eye, square; size in pixels. A map is wider by its colour bar.
  Image8 draw(SceneOptions options, int size, Mode mode, int samples = 64) {
    options.eye = "right";
    options.size = std::to_string(size) + "x" + std::to_string(size);
    const RenderSetup setup = make_render_setup(options, scene_);
    render::FrameConfig config;
    config.width = config.height = size;
    config.mode = mode;
    config.samples = samples;
    config.range = mode == Mode::astigmatism ? kAstigmatismRange : kPowerRange;
    const Image8 picture = compose_display({size, size, 1, 1}, renderer_.render(setup.lenses, setup.views, config));
    return render::is_map(mode) ? with_bar(picture, *config.range, mode == Mode::power ? "power" : "astigmatism")
                                : picture;
  }

 private:
  render::Scene scene_;
  render::Renderer renderer_;
};

SceneOptions progressive() {
  SceneOptions options;
  options.wearer = built_in_asset("wearers/presbyopia.json").string();
  options.spectacles = built_in_asset("spectacles/presbyopia_bspline_sphere.json").string();
  return options;
}

// A view with its astigmatism and power as insets in the lower corners.
Image8 with_insets(Studio& studio, const SceneOptions& options) {
  constexpr int kSize = 640, kInset = 164;
  Image8 picture = studio.draw(options, kSize, Mode::adof);
  constexpr int kTop = kSize - kInset - kGap;
  for (const Mode mode : {Mode::astigmatism, Mode::power}) {
    const Image8 map = studio.draw(options, kInset, mode);
    const int x = mode == Mode::astigmatism ? kGap : kSize - map.width - kGap;
    render::fill_rect(picture, {x - 2, kTop - 2, map.width + 4, map.height + 4}, kPaper);
    blit(picture, map, x, kTop);
  }
  return picture;
}

Image8 figure_1(Studio& studio) {
  SceneOptions far = progressive(), near = progressive();
  far.fov_deg = near.fov_deg = 50.0;
  far.gaze = "0,0";
  near.look_at = studio.has_target("near_card") ? "near_card" : "";
  if (near.look_at.empty()) {
    near.gaze = "0,-30";
  }
  return beside({{"far, insets: astigmatism, power", with_insets(studio, far)},
                 {"near, insets: astigmatism, power", with_insets(studio, near)}});
}

// The lens over the turning eye. From 30 km up everything is as good as infinitely far.
Image8 figure_4(Studio& studio) {
  constexpr int kSize = 560;
  SceneOptions options = progressive();
  options.viewing = "scanning";
  options.pose = "0,30000,0,0,0";
  options.fov_deg = 80.0;
  return beside({{"astigmatism", studio.draw(options, kSize, Mode::astigmatism)},
                 {"power", studio.draw(options, kSize, Mode::power)}});
}

Image8 figure_5(Studio& studio) {
  constexpr int kSize = 460;
  SceneOptions options = progressive();
  options.fov_deg = 80.0;
  return beside({{"pinhole view", studio.draw(options, kSize, Mode::pinhole)},
                 {"astigmatism", studio.draw(options, kSize, Mode::astigmatism)},
                 {"power", studio.draw(options, kSize, Mode::power)}});
}

// Text at 0.7 m through +4.00 before an eye that needs no lens: the focus lies before it, whatever the eye does.
Image8 figure_6(Studio& studio) {
  constexpr int kSize = 560, kSamples = 128;
  SceneOptions options;
  options.spectacles = built_in_asset("spectacles/hyperopia.json").string();
  options.gaze = "-4,-7";
  options.fov_deg = 18.0;
  return beside({{"approximate defocus (adof)", studio.draw(options, kSize, Mode::adof)},
                 {"distributed rays (dof)", studio.draw(options, kSize, Mode::dof, kSamples)}});
}

}  // namespace

std::vector<std::string> write_figures(const FigureOptions& options,
                                       const std::function<void(const std::string& name)>& progress) {
  render::vk::Device device = open_device(options.device);
  Studio scene(device, options.scene), room(device, built_in_scene().string());
  std::vector<std::string> files;
  const auto make = [&](const std::string& name, Image8 (*draw)(Studio&), Studio& studio) {
    progress(name);
    const std::filesystem::path file = options.folder / name;
    render::write_png(file, draw(studio));
    files.push_back(file.string());
  };
  make("figure_1.png", figure_1, scene);
  make("figure_4.png", figure_4, scene);
  make("figure_5.png", figure_5, scene);
  make("figure_6.png", figure_6, room);
  close_device(device);
  return files;
}

}  // namespace app
