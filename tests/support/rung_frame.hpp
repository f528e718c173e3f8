// The rays of a picture through a lens in the form that an accuracy asks for, beside the double-precision reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <vector>

#include "render/frame_job.hpp"
#include "render/gpu_tracer.hpp"
#include "render/lens_forms/lens_form_cache.hpp"
#include "render/lens_forms/tile_cubics.hpp"
#include "tests/support/cubic_picture.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/worn_views.hpp"

namespace support {

struct Spread {
  double median = 0.0, p99 = 0.0, greatest = 0.0;
};

inline Spread spread_of(std::vector<double> values) {
  if (values.empty()) {
    return {};
  }
  std::ranges::sort(values);
  const auto at = [&](double part) {
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
  };
  return {at(0.5), at(0.99), values.back()};
}

struct RungErrors {
  Spread direction, position, power, astigmatism;  // rad, m, D, D
  std::size_t through = 0;                         // pixels that pass the lens in both
  std::size_t status_differs = 0;                  // anywhere
  std::size_t status_differs_inside = 0;           // where all pixels around are of one status
  bool finite = true;                              // all that any later kernel reads
};

// What the reference makes of every pixel; the object at infinity.
struct ReferencePicture {
  struct Pixel {
    int status;
    glm::dvec3 start, direction, vergence;
    bool inside;  // all neighbours have the same status
  };
  int size = 0;
  std::vector<Pixel> pixels;

  ReferencePicture(const WornPair& pair, const render::ViewSetup& view, int side) : size(side) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto ray = reference_pixel(pair, view, pixel_direction(view, x, y, size, size));
        const auto record =
            f64::trace_record(f64::Table{pair.model.table}, pair.model.lens[view.lens], view.eye, ray.ray);
        pixels.push_back({record.status.x, ray.start, ray.direction, glm::dvec3(record.vergence), false});
      }
    }
    for (int y = 1; y + 1 < size; ++y) {
      for (int x = 1; x + 1 < size; ++x) {
        bool same = true;
        for (int k = 0; k < 9; ++k) {
          same = same && at(x + k % 3 - 1, y + k / 3 - 1).status == at(x, y).status;
        }
        at(x, y).inside = same;
      }
    }
  }

  [[nodiscard]] Pixel& at(int x, int y) { return pixels[static_cast<std::size_t>(y * size + x)]; }
};

// An empty scene on a device; what frames of rungs share.
struct RungDevice {
  render::vk::Device device;
  render::SceneBuffers scene{device,
                             patch_scene({Patch{{-1.0F, -1.0F, 50.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F}, 1.0F}})};
  render::KernelSet kernels{device};
};

// A frame of one view, all of it sky, so that wavefronts are those of objects at infinity.
class RungFrame {
 public:
  RungFrame(RungDevice& shared, const WornPair& pair, const render::ViewSetup& view, const render::LensAccuracy& lens,
            int size, render::Traversal traversal = render::Traversal::tile)
      : device_(shared.device),
        config_(config_of(lens, size)),
        eye_(view.world_from_eye.position),
        cubic_(render::may_be_cubic(config_, {view}, traversal) &&
               render::can_be_cubic(device_.limits(), render::surface_kinds({pair.model.lens[view.lens]}))),
        out_(device_, render::buffers_for(config_, {view}, traversal)),
        commands_(device_) {
    // The second frame of a running picture is the one to look at: a field is known by then.
    const auto& model = forms_.in_form(pair.model, lens);
    render::vk::Commands first(device_);
    render::FrameJob(device_, shared.scene, shared.kernels, out_, model, {view}, config_, traversal)
        .record_trace(first);
    device_.run(first);
    render::FrameJob(device_, shared.scene, shared.kernels, out_, model, {view}, config_, traversal)
        .record_trace(commands_);
  }

  std::vector<render::vk::StageTime> run() { return device_.run(commands_); }

  // After run(), as render/frame_buffers.hpp has them.
  [[nodiscard]] const render::FrameBuffers& buffers() const { return out_; }

  // After run().
  [[nodiscard]] RungErrors against(const ReferencePicture& reference) const {
    const std::size_t count = reference.pixels.size();
    const auto wavefronts = out_.wavefronts.read<glm::vec4>(2 * count);
    const auto origins = out_.ray_origins.read<glm::vec4>(count);
    const auto directions = out_.ray_directions.read<glm::vec4>(count);
    const CubicPicture cubic = cubic_ ? CubicPicture(out_, reference.size) : CubicPicture();
    RungErrors errors;
    std::vector<double> direction, position, power, astigmatism;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& expected = reference.pixels[i];
      const int x = static_cast<int>(i) % reference.size, y = static_cast<int>(i) / reference.size;
      const bool smooth = cubic.is_smooth(x, y);
      const CubicRay ray = smooth ? cubic.at(x, y) : CubicRay{glm::dvec3(origins[i]), glm::dvec3(directions[i])};
      const glm::dvec3 start = smooth ? ray.origin + eye_ : ray.origin;
      for (const glm::dvec4& v : {glm::dvec4(wavefronts[2 * i]), glm::dvec4(wavefronts[2 * i + 1]),
                                  glm::dvec4(start, 0.0), glm::dvec4(ray.direction, 0.0)}) {
        errors.finite = errors.finite && std::isfinite(v.x + v.y + v.z + v.w);
      }
      const float told = smooth ? 1.0F : directions[i].w;
      const int status = told > 0.0F ? f64::kStatusOk : told < 0.0F ? static_cast<int>(-told) : f64::kStatusMissBack;
      if (status != expected.status) {
        ++errors.status_differs;
        errors.status_differs_inside += expected.inside ? 1 : 0;
        continue;
      }
      if (status != f64::kStatusOk) {
        continue;
      }
      ++errors.through;
      direction.push_back(glm::length(ray.direction - expected.direction));
      position.push_back(glm::length(start - expected.start));
      const glm::dvec3 got = f64::principal(glm::dvec3(wavefronts[2 * i]));
      const glm::dvec3 wanted = f64::principal(expected.vergence);
      power.push_back(0.5 * std::abs(got.x + got.y - wanted.x - wanted.y));
      astigmatism.push_back(std::abs(got.x - got.y - wanted.x + wanted.y));
    }
    errors.direction = spread_of(direction);
    errors.position = spread_of(position);
    errors.power = spread_of(power);
    errors.astigmatism = spread_of(astigmatism);
    return errors;
  }

 private:
  static render::FrameConfig config_of(const render::LensAccuracy& lens, int size) {
    render::FrameConfig config;
    config.width = config.height = size;
    config.mode = render::Mode::power;
    config.range = render::MapRange{0.0, 1.0};
    config.accuracy.lens = lens;
    if (lens.cubics == render::TileCubics::in_pictures) {
      config.accuracy.lens.cubics = render::TileCubics::always;  // as pictures have them
    }
    return config;
  }

  render::vk::Device& device_;
  render::FrameConfig config_;
  glm::dvec3 eye_;  // where the view's pupil is; the heads stand at the origin, unturned
  bool cubic_;
  render::LensFormCache forms_;
  render::FrameBuffers out_;
  render::vk::Commands commands_;
};

}  // namespace support
