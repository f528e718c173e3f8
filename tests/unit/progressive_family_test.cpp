// The closed-form progressive front, its B-spline fit, and the example spectacles made of it. The figures (distance
// point, near point, 85 % of the addition, peak cylinder, the fit's deviations) were computed independently of this
// code from the formulas at the head of progressive_family.hpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "assets/generator/spectacles_writer.hpp"
#include "lenses/bspline_field.hpp"
#include "lenses/design/progressive_family.hpp"

namespace {

using Height = std::function<double(double, double)>;
using lenses::BsplineHeightField;
using nlohmann::json;

constexpr double kIndex = 1.6;

struct SurfacePower {
  double mean, cylinder;  // D
};

// From the first and second fundamental forms of a height field; derivatives by central differences. With h = 0.2 mm
// the truncation is below 1e-4 D (the corridor is 18 mm long) and rounding below 1e-6 D.
SurfacePower surface_power(const Height& z, double x, double y) {
  const double h = 2e-4;
  const double zx = (z(x + h, y) - z(x - h, y)) / (2 * h), zy = (z(x, y + h) - z(x, y - h)) / (2 * h);
  const double zxx = (z(x + h, y) - 2 * z(x, y) + z(x - h, y)) / (h * h);
  const double zyy = (z(x, y + h) - 2 * z(x, y) + z(x, y - h)) / (h * h);
  const double zxy = (z(x + h, y + h) - z(x + h, y - h) - z(x - h, y + h) + z(x - h, y - h)) / (4 * h * h);
  const double e = 1 + zx * zx, f = zx * zy, g = 1 + zy * zy, w = std::sqrt(1 + zx * zx + zy * zy);
  const double mean = (e * zyy - 2 * f * zxy + g * zxx) / (2 * w * w * w);
  const double gauss = (zxx * zyy - zxy * zxy) / (w * w * w * w);
  return {(kIndex - 1) * mean, 2 * (kIndex - 1) * std::sqrt(std::max(0.0, mean * mean - gauss))};
}

Height closed_form() {
  return [surface = lenses::ProgressiveFamily()](double x, double y) { return surface.height(x, y); };
}

double height(const BsplineHeightField& net, double x, double y) {
  return lenses::HeightFieldReader(net).at({x, y}).z;
}

// The fit in the coordinates of the closed form (x mirrored back).
Height fitted() {
  return [net = assets::progressive_front_right()](double x, double y) { return height(net, -x, y); };
}

// Calls f at every point of a square grid (step in metres) inside a disc.
template <typename F>
void over_disc(double radius, double step, const F& f) {
  const int n = static_cast<int>(radius / step);
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      const double x = i * step, y = j * step;
      if (x * x + y * y <= radius * radius) f(x, y);
    }
  }
}

json read_json(const std::string& path) {
  std::ifstream stream(path);
  EXPECT_TRUE(stream.good()) << path;
  return json::parse(stream);
}

BsplineHeightField net_of(const json& surface) {
  BsplineHeightField net;
  for (const json& knot : surface.at("knots_x_mm")) net.knots_x.push_back(1e-3 * knot.get<double>());
  net.knots_y = net.knots_x;
  for (const json& row : surface.at("control_z_mm")) {
    for (const json& z : row) net.control_z.push_back(1e-3 * z.get<double>());
  }
  return net;
}

TEST(ClosedForm, PowersAtTheReferencePoints) {
  const Height z = closed_form();
  EXPECT_NEAR(surface_power(z, 0.0, 0.008).mean, 5.00, 0.005);
  EXPECT_NEAR(surface_power(z, 0.002, -0.012).mean, 6.995, 0.003);  // 6.9975 here; a step of 2 mm gives 6.9943
}

TEST(ClosedForm, MeridianIsUmbilicAndReaches85PercentOfTheAddition) {
  const Height z = closed_form();
  const lenses::ProgressiveFamilyConfig config;
  double reached_at = 0.0;
  for (double below = 0.0; below < 0.025; below += 5e-5) {
    const double x = below * std::sin(config.inset), y = config.fitting_cross - below * std::cos(config.inset);
    const SurfacePower power = surface_power(z, x, y);
    // A discriminant of squares: differences of 1e-6 D in the curvatures become 1e-3 D.
    EXPECT_LT(power.cylinder, 0.01) << "below the cross by " << below;
    if (reached_at == 0.0 && power.mean >= 5.0 + 0.85 * 2.0) reached_at = below;
  }
  EXPECT_NEAR(reached_at, 0.0118, 1e-4);  // stated to 0.1 mm
}

TEST(ClosedForm, PeakCylinderAndCorridorWidth) {
  const Height z = closed_form();
  double peak = 0.0;
  over_disc(0.030, 5e-4, [&](double x, double y) { peak = std::max(peak, surface_power(z, x, y).cylinder); });
  EXPECT_NEAR(peak, 2.21, 0.01);
  double narrow = 0.0;
  for (double x = -0.01; x < 0.01; x += 2e-5) {
    if (surface_power(z, x, -0.003).cylinder < 0.5) narrow += 2e-5;
  }
  EXPECT_NEAR(narrow, 0.0025, 1e-4);
}

TEST(BsplineFit, ReproducesACubicExactly) {
  const Height cubic = [](double x, double y) { return 2.0 * x * x + 30.0 * x * y * y - 5.0 * y * y * y; };
  const BsplineHeightField net = lenses::fit_height_field(cubic, 20, 0.03);
  over_disc(0.03, 1.7e-3, [&](double x, double y) { EXPECT_NEAR(height(net, x, y), cubic(x, y), 1e-15); });
}

TEST(BsplineFit, HeightPowerAndCylinderOfTheFit) {
  const Height truth = closed_form(), fit = fitted();
  double height = 0.0, power = 0.0, cylinder = 0.0;
  over_disc(0.030, 7e-4, [&](double x, double y) {
    const SurfacePower a = surface_power(truth, x, y), b = surface_power(fit, x, y);
    height = std::max(height, std::abs(truth(x, y) - fit(x, y)));
    power = std::max(power, std::abs(a.mean - b.mean));
    cylinder = std::max(cylinder, std::abs(a.cylinder - b.cylinder));
  });
  EXPECT_LE(height, 0.011e-6 * 1.2);  // 0.011 um, the grid of the sites may differ
  EXPECT_LE(power, 0.04);
  EXPECT_LE(cylinder, 0.065);
}

TEST(ProgressiveLens, AgreesWithTheReferenceLens) {
  const BsplineHeightField ours = assets::progressive_front_right();
  const BsplineHeightField reference =
      net_of(read_json(std::string(VERGENCE_TEST_DATA) + "/progressive_add200_right.json").at("front"));
  ASSERT_EQ(ours.count_x(), reference.count_x());
  double worst = 0.0;
  over_disc(0.030, 5e-4, [&](double x, double y) {
    worst = std::max(worst, std::abs(height(ours, x, y) - height(reference, x, y)));
  });
  EXPECT_LT(worst, 0.5e-6);
}

TEST(ProgressiveLens, NearZoneIsNasalAndTheLeftLensIsTheMirrorImage) {
  const BsplineHeightField right = assets::progressive_front_right(), left = lenses::mirrored(right);
  // The wearer's right eye has its nose toward -x.
  const auto mean = [](const BsplineHeightField& net, double x) {
    return surface_power([&](double a, double b) { return height(net, a, b); }, x, -0.010).mean;
  };
  EXPECT_GT(mean(right, -0.006), mean(right, 0.006) + 0.3);
  EXPECT_GT(mean(left, 0.006), mean(left, -0.006) + 0.3);
  over_disc(0.030, 2e-3, [&](double x, double y) { EXPECT_NEAR(height(left, x, y), height(right, -x, y), 1e-16); });
}

// Back vertex power of a vertex section, from the radii in a file.
double vertex_power(const json& lens, const char* back_radius) {
  const double n = lens.at("index"), t = 1e-3 * lens.at("centre_thickness_mm").get<double>();
  const double front = (n - 1) * 1000.0 / lens.at("front").at("radius_mm").get<double>();
  const double back = (1 - n) * 1000.0 / lens.at("back").at(back_radius).get<double>();
  return front / (1 - t * front / n) + back;
}

// Radii are rounded to 0.1 um; of a 50 mm radius that is 3e-5 D.
constexpr double kRadiusRounding = 5e-5;

TEST(Spectacles, SingleVisionPowersAreTheOrders) {
  const std::string folder = std::string(VERGENCE_ASSETS) + "/spectacles/";
  for (const char* side : {"right", "left"}) {
    EXPECT_NEAR(vertex_power(read_json(folder + "myopia.json").at(side), "radius_mm"), -6.0, kRadiusRounding);
    EXPECT_NEAR(vertex_power(read_json(folder + "hyperopia.json").at(side), "radius_mm"), 4.0, kRadiusRounding);
    EXPECT_NEAR(vertex_power(read_json(folder + "emmetropia.json").at(side), "radius_mm"), 0.0, kRadiusRounding);
    const json toric = read_json(folder + "astigmatism.json").at(side);
    EXPECT_EQ(toric.at("back").at("axis_deg"), 160.0);  // TABO 20 as the wearer sees it
    EXPECT_NEAR(vertex_power(toric, "radius_u_mm"), -1.0, kRadiusRounding);
    EXPECT_NEAR(vertex_power(toric, "radius_v_mm"), -3.5, kRadiusRounding);
  }
}

TEST(Spectacles, ThePlusLensHasAnEdge) {
  const json lens = read_json(std::string(VERGENCE_ASSETS) + "/spectacles/hyperopia.json").at("right");
  const double r = 0.5 * lens.at("diameter_mm").get<double>();
  const auto sag = [&](const char* surface) {
    const double radius = lens.at(surface).at("radius_mm");
    return radius - std::sqrt(radius * radius - r * r);
  };
  EXPECT_GT(lens.at("centre_thickness_mm").get<double>() - sag("front") + sag("back"), 0.8);
}

TEST(Spectacles, CommittedFilesAreWhatTheGeneratorWrites) {
  for (const auto& [path, text] : assets::spectacles_files()) {
    std::ifstream stream(std::string(VERGENCE_ASSETS) + "/" + path);
    std::ostringstream committed;
    committed << stream.rdbuf();
    const json a = json::parse(committed.str()), b = json::parse(text);
    for (const char* side : {"right", "left"}) {
      if (!b.contains(side)) continue;
      json left = a.at(side), made = b.at(side);
      if (made.at("front").at("type") == "bspline") {
        // Another compiler's rounding may move a control point's last digit.
        const BsplineHeightField x = net_of(left.at("front")), y = net_of(made.at("front"));
        ASSERT_EQ(x.control_z.size(), y.control_z.size()) << path;
        for (std::size_t i = 0; i < x.control_z.size(); ++i) EXPECT_NEAR(x.control_z[i], y.control_z[i], 1e-11) << path;
        left.erase("front");
        made.erase("front");
      }
      EXPECT_EQ(left, made) << path << " " << side;
    }
  }
}

}  // namespace
