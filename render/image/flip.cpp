#include "render/image/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>

#include "render/image/srgb.hpp"

namespace render {
namespace {

using Plane = std::vector<double>;
using Colour = std::array<double, 3>;
using Planes = std::array<Plane, 3>;

// Section 4.1.3: exponent, and the knee of the map from colour difference to error.
constexpr double kColourExponent = 0.7, kKneeAt = 0.4, kKneeError = 0.95;
// Section 4.2: exponent of the feature difference, and the width of a feature in degrees.
constexpr double kFeatureExponent = 0.5, kFeatureWidth = 0.082;

// sRGB's primaries and white, D65, to the digits of IEC 61966-2-1.
constexpr std::array<Colour, 3> kXyzFromRgb{
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};

Colour white() {
  Colour w{};
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = kXyzFromRgb[i][0] + kXyzFromRgb[i][1] + kXyzFromRgb[i][2];
  }
  return w;
}

Colour xyz_over_white(const Colour& rgb) {
  const Colour w = white();
  Colour xyz{};
  for (std::size_t i = 0; i < 3; ++i) {
    xyz[i] = (kXyzFromRgb[i][0] * rgb[0] + kXyzFromRgb[i][1] * rgb[1] + kXyzFromRgb[i][2] * rgb[2]) / w[i];
  }
  return xyz;
}

// Linearised CIELAB, in which contrast sensitivity is measured.
Colour opponent(const Colour& rgb) {
  const Colour n = xyz_over_white(rgb);
  return {116.0 * n[1] - 16.0, 500.0 * (n[0] - n[1]), 200.0 * (n[1] - n[2])};
}

// Cramer's rule on the matrix above.
Colour rgb_of_xyz(const Colour& xyz) {
  const auto& m = kXyzFromRgb;
  const auto det = [](const Colour& a, const Colour& b, const Colour& c) {  // of columns
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) + c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const Colour r{m[0][0], m[1][0], m[2][0]}, g{m[0][1], m[1][1], m[2][1]}, b{m[0][2], m[1][2], m[2][2]};
  const double whole = det(r, g, b);
  return {det(xyz, g, b) / whole, det(r, xyz, b) / whole, det(r, g, xyz) / whole};
}

// Back to colours that the display can show.
Colour shown(const Colour& opponent_colour) {
  const Colour w = white();
  const double y = (opponent_colour[0] + 16.0) / 116.0;
  Colour rgb = rgb_of_xyz({w[0] * (y + opponent_colour[1] / 500.0), w[1] * y, w[2] * (y - opponent_colour[2] / 200.0)});
  for (double& c : rgb) {
    c = std::clamp(c, 0.0, 1.0);
  }
  return rgb;
}

// CIELAB with chroma in proportion to lightness (Hunt): dark colours look less colourful.
Colour hunt_lab(const Colour& rgb) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Colour n = xyz_over_white(rgb);
  const double lightness = 116.0 * f(n[1]) - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f(n[0]) - f(n[1])), 0.01 * lightness * 200.0 * (f(n[1]) - f(n[2]))};
}

double hyab(const Colour& a, const Colour& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

double colour_error(const Colour& a, const Colour& b) {
  static const double largest =
      std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), kColourExponent);  // green against blue
  const double difference = std::pow(hyab(a, b), kColourExponent);
  const double knee = kKneeAt * largest;
  return difference < knee ? difference * kKneeError / knee
                           : kKneeError + (difference - knee) / (largest - knee) * (1.0 - kKneeError);
}

// Weights at the pixels -r..r.
using Weights = std::vector<double>;

Weights sampled(int radius, const auto& f) {
  Weights weights;
  for (int i = -radius; i <= radius; ++i) {
    weights.push_back(f(static_cast<double>(i)));
  }
  return weights;
}

// Positive weights sum to 1, negative ones to -1; a sum that is none, as too far below a pixel's width, stays one.
Weights balanced(Weights weights) {
  double positive = 0.0, negative = 0.0;
  for (const double w : weights) {
    (w > 0.0 ? positive : negative) += w;
  }
  for (double& w : weights) {
    const double sum = w > 0.0 ? positive : -negative;
    w = sum > 0.0 ? w / sum : 0.0;
  }
  return weights;
}

// Rows, then columns; beyond the border the nearest pixel goes on.
class Filter {
 public:
  Filter(int width, int height) : width_(width), height_(height) {}

  [[nodiscard]] Plane operator()(const Plane& in, const Weights& across, const Weights& down) const {
    return along(along(in, across, true), down, false);
  }

 private:
  [[nodiscard]] Plane along(const Plane& in, const Weights& weights, bool rows) const {
    const int radius = static_cast<int>(weights.size() / 2);
    Plane out(in.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        double sum = 0.0;
        for (int k = -radius; k <= radius; ++k) {
          const int u = rows ? std::clamp(x + k, 0, width_ - 1) : x;
          const int v = rows ? y : std::clamp(y + k, 0, height_ - 1);
          sum += weights[static_cast<std::size_t>(k + radius)] * in[index(u, v)];
        }
        out[index(x, y)] = sum;
      }
    }
    return out;
  }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_, height_;
};

// One term of a contrast sensitivity function as it stands in space: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees
// (Johnson and Fairchild 2003, table 1 of the paper).
struct Term {
  double a, b;
};
constexpr Term kAchromatic[]{{1.0, 0.0047}}, kRedGreen[]{{1.0, 0.0053}}, kBlueYellow[]{{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestTerm = 0.04;

// The two-dimensional kernel is the sum of its terms' products over x and y; it sums to 1.
Plane contrast_filtered(const Plane& in, std::span<const Term> terms, const Filter& filter, double pixels_per_degree) {
  constexpr double kPi = std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidestTerm / (2.0 * kPi * kPi)) * pixels_per_degree));
  Plane sum(in.size());
  double whole = 0.0;
  for (const Term& term : terms) {
    Weights weights = sampled(radius, [&](double i) {
      const double x = i / pixels_per_degree;
      return std::exp(-kPi * kPi * x * x / term.b);
    });
    double one_way = 0.0;
    for (const double w : weights) {
      one_way += w;
    }
    const double share = term.a * std::sqrt(kPi / term.b) * one_way * one_way;
    for (double& w : weights) {
      w /= one_way;
    }
    const Plane part = filter(in, weights, weights);
    for (std::size_t i = 0; i < in.size(); ++i) {
      sum[i] += share * part[i];
    }
    whole += share;
  }
  for (double& value : sum) {
    value /= whole;
  }
  return sum;
}

// How strong edges and points are at each pixel of the luminance.
struct Features {
  Plane edges, points;
};

Features features_of(const Plane& luminance, const Filter& filter, double pixels_per_degree) {
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto bell = [&](double i) { return std::exp(-i * i / (2.0 * deviation * deviation)); };
  Weights across = sampled(radius, bell);
  double sum = 0.0;
  for (const double w : across) {
    sum += w;
  }
  for (double& w : across) {
    w /= sum;
  }
  const Weights slope = balanced(sampled(radius, [&](double i) { return -i * bell(i); }));
  const Weights bend =
      balanced(sampled(radius, [&](double i) { return (i * i / (deviation * deviation) - 1.0) * bell(i); }));
  const auto strength = [&](const Weights& derivative) {
    Plane x = filter(luminance, derivative, across);
    const Plane y = filter(luminance, across, derivative);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = std::hypot(x[i], y[i]);
    }
    return x;
  };
  return {strength(slope), strength(bend)};
}

// What an eye makes of an image: filtered colours and unfiltered features.
struct Seen {
  std::vector<Colour> colours;
  Features features;
};

Seen seen(const Image8& image, double pixels_per_degree) {
  const std::size_t pixels = image.rgb.size() / 3;
  Planes planes;
  Plane luminance(pixels);
  for (Plane& plane : planes) {
    plane.resize(pixels);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    const Colour colour =
        opponent({srgb_decode(image.rgb[3 * i]), srgb_decode(image.rgb[3 * i + 1]), srgb_decode(image.rgb[3 * i + 2])});
    for (std::size_t c = 0; c < 3; ++c) {
      planes[c][i] = colour[c];
    }
    luminance[i] = (colour[0] + 16.0) / 116.0;
  }
  const Filter filter(image.width, image.height);
  planes[0] = contrast_filtered(planes[0], kAchromatic, filter, pixels_per_degree);
  planes[1] = contrast_filtered(planes[1], kRedGreen, filter, pixels_per_degree);
  planes[2] = contrast_filtered(planes[2], kBlueYellow, filter, pixels_per_degree);
  Seen result;
  for (std::size_t i = 0; i < pixels; ++i) {
    result.colours.push_back(hunt_lab(shown({planes[0][i], planes[1][i], planes[2][i]})));
  }
  result.features = features_of(luminance, filter, pixels_per_degree);
  return result;
}

}  // namespace

Flip flip(const Image8& image, const Image8& reference, double pixels_per_degree) {
  check_image(image);
  check_image(reference);
  if (image.width != reference.width || image.height != reference.height) {
    throw std::invalid_argument("only images of one size can be compared");
  }
  if (!(pixels_per_degree > 0.0) || !std::isfinite(pixels_per_degree)) {
    throw std::invalid_argument("pixels per degree must be above 0");
  }
  const Seen a = seen(image, pixels_per_degree), b = seen(reference, pixels_per_degree);
  Flip result;
  for (std::size_t i = 0; i < a.colours.size(); ++i) {
    const double edges = std::abs(a.features.edges[i] - b.features.edges[i]);
    const double points = std::abs(a.features.points[i] - b.features.points[i]);
    const double feature = std::pow(std::max(edges, points) / std::numbers::sqrt2, kFeatureExponent);
    const double error = std::pow(colour_error(a.colours[i], b.colours[i]), 1.0 - feature);
    result.map.push_back(static_cast<float>(error));
    result.mean += error;
  }
  result.mean /= static_cast<double>(result.map.size());
  return result;
}

}  // namespace render
