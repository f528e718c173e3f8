#include "assets/generator/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace assets {
namespace {

// Lattice value in [0, 1): an integer hash (the finaliser of MurmurHash3).
double lattice(int x, int y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U ^ seed;
  h = (h ^ (h >> 16)) * 0x85EBCA6BU;
  h = (h ^ (h >> 13)) * 0xC2B2AE35U;
  return static_cast<double>(h ^ (h >> 16)) / 4294967296.0;
}

double noise(double x, double y, std::uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
  const double u = glm::smoothstep(0.0, 1.0, x - fx), v = glm::smoothstep(0.0, 1.0, y - fy);
  return glm::mix(glm::mix(lattice(ix, iy, seed), lattice(ix + 1, iy, seed), u),
                  glm::mix(lattice(ix, iy + 1, seed), lattice(ix + 1, iy + 1, seed), u), v);
}

double layered_noise(double x, double y, std::uint32_t seed) {
  return 0.55 * noise(x, y, seed) + 0.3 * noise(2.1 * x, 2.1 * y, seed + 1) + 0.15 * noise(4.3 * x, 4.3 * y, seed + 2);
}

// colour_at(u, v): linear colour at u, v in [0, 1], v down.
template <typename ColourAt>
Picture paint(const char* name, int width, int height, const ColourAt& colour_at) {
  Picture picture{.name = name, .width = width, .height = height};
  picture.rgb.reserve(static_cast<std::size_t>(3) * static_cast<std::size_t>(width * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 linear = colour_at((x + 0.5) / width, (y + 0.5) / height);
      for (int c = 0; c < 3; ++c) {
        const double v = std::clamp(linear[c], 0.0, 1.0);
        const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
        picture.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * encoded)));
      }
    }
  }
  return picture;
}

// Grain runs along u; length and width in metres set its scale.
glm::dvec3 wood(double along, double across, std::uint32_t seed, const glm::dvec3& light, const glm::dvec3& dark) {
  const double bend = 0.06 * noise(1.3 * along, 6.0 * across, seed);
  const double rings = 0.5 + 0.5 * std::sin(glm::two_pi<double>() * 14.0 * (across + bend));
  const double fibres = layered_noise(6.0 * along, 220.0 * across, seed + 7);
  return glm::mix(light, dark, std::clamp(0.35 * rings + 0.75 * fibres - 0.15, 0.0, 1.0));
}

// 1 in the open, falling to `least` where distance (m) to an edge falls to nothing.
double edge_shade(double distance, double reach, double least) {
  return glm::mix(least, 1.0, glm::smoothstep(-0.3 * reach, reach, distance));
}

}  // namespace

Picture wood_picture(int size) {
  return paint("wood", size, size, [](double u, double v) {
    return wood(u, v, 11, {0.42, 0.25, 0.12}, {0.23, 0.115, 0.048});
  });
}

Picture floor_picture(int width, int height, double metres_x, double metres_z) {
  constexpr double kBoard = 0.14, kLength = 1.6;  // m
  return paint("floor_boards", width, height, [=](double u, double v) {
    const double x = u * metres_x, z = v * metres_z;
    const int column = static_cast<int>(x / kBoard);
    const double shifted = z + kLength * lattice(column, 3, 21);
    const int row = static_cast<int>(shifted / kLength);
    const double tone = 0.82 + 0.3 * lattice(column, row, 22);
    const double in_board = x - kBoard * column, in_length = shifted - kLength * row;
    const bool joint = in_board < 0.004 || in_length < 0.004;
    const glm::dvec3 colour =
        wood(z, x, 31U + static_cast<std::uint32_t>(7 * column + row), {0.50, 0.34, 0.19}, {0.33, 0.20, 0.10});
    const double shade = edge_shade(std::min({x, z, metres_x - x, metres_z - z}), 0.7, 0.62);
    return colour * tone * shade * (joint ? 0.55 : 1.0);
  });
}

Picture plaster_picture(int width, int height) {
  return paint("plaster", width, height, [](double u, double v) {
    const double grain = 0.985 + 0.03 * layered_noise(60.0 * u, 30.0 * v, 41);
    const double shade =
        edge_shade(2.6 * std::min(v, 1.0 - v), 0.55, 0.80) * edge_shade(5.0 * std::min(u, 1.0 - u), 0.7, 0.80);
    return glm::dvec3(0.80, 0.775, 0.72) * grain * shade;
  });
}

Picture rug_picture(int width, int height) {
  return paint("rug", width, height, [](double u, double v) {
    const glm::dvec3 red(0.36, 0.07, 0.055), blue(0.06, 0.09, 0.19), cream(0.62, 0.54, 0.40), ochre(0.50, 0.29, 0.08);
    const double x = 1.5 * u, edge = std::min({x, v, 1.5 - x, 1.0 - v});
    glm::dvec3 colour = red;
    const double lozenge = std::abs(std::remainder(x, 0.25)) + std::abs(std::remainder(v - 0.5, 0.25));
    if (lozenge < 0.05) colour = ochre;
    if (lozenge > 0.105 && lozenge < 0.125) colour = cream;
    if (edge < 0.13) colour = std::abs(std::remainder(x + v, 0.08)) < 0.014 ? cream : blue;
    if (edge < 0.03 || std::abs(edge - 0.13) < 0.008) colour = cream;
    const double threads = 0.80 + 0.25 * layered_noise(90.0 * u, 90.0 * v, 51) + 0.08 * std::sin(900.0 * v);
    return colour * threads;
  });
}

Picture bay_picture(int width, int height) {
  return paint("painting_bay", width, height, [](double u, double v) {
    const double brush = 0.85 + 0.3 * layered_noise(25.0 * u, 60.0 * v, 61);
    if (v < 0.52) {  // sky with clouds
      const double cloud = glm::smoothstep(0.5, 0.75, layered_noise(5.0 * u, 9.0 * v, 62));
      const double from_left = std::abs(u - 0.62), sail_half = 0.30 * (v - 0.22);
      if (v > 0.22 && from_left < sail_half && (u > 0.625 || from_left < 0.6 * sail_half))
        return glm::dvec3(0.85, 0.8, 0.7) * brush;
      return glm::mix(glm::mix(glm::dvec3(0.16, 0.34, 0.6), glm::dvec3(0.62, 0.7, 0.72), v * 1.9),
                      glm::dvec3(0.85, 0.84, 0.8), cloud) *
             brush;
    }
    const double shore = 0.80 + 0.06 * noise(4.0 * u, 0.0, 63);
    if (v > shore) return glm::dvec3(0.62, 0.50, 0.30) * brush;
    if (std::abs(u - 0.62) < 0.12 - 1.6 * std::abs(v - 0.53) && v < 0.56) return glm::dvec3(0.22, 0.06, 0.04);
    const double glitter = noise(40.0 * u, 160.0 * v, 64) > 0.82 ? 1.7 : 1.0;
    return glm::mix(glm::dvec3(0.10, 0.32, 0.42), glm::dvec3(0.05, 0.20, 0.24), (v - 0.52) * 3.0) * brush * glitter;
  });
}

Picture evening_picture(int width, int height) {
  return paint("painting_evening", width, height, [](double u, double v) {
    const double brush = 0.85 + 0.3 * layered_noise(30.0 * u, 30.0 * v, 71);
    glm::dvec3 colour =
        glm::mix(glm::dvec3(0.20, 0.10, 0.28), glm::dvec3(0.95, 0.50, 0.16), glm::smoothstep(0.0, 0.55, v));
    if (glm::length(glm::dvec2((u - 0.4) * 0.75, v - 0.42)) < 0.07) colour = {1.0, 0.86, 0.5};
    for (int ridge = 0; ridge < 4; ++ridge) {
      const double top = 0.46 + 0.12 * ridge - 0.16 * layered_noise(3.0 * u + 5.0 * ridge, 0.3 * ridge, 72);
      if (v > top) colour = glm::mix(glm::dvec3(0.32, 0.15, 0.22), glm::dvec3(0.03, 0.05, 0.05), ridge / 3.0);
    }
    return colour * brush;
  });
}

}  // namespace assets
