// Job files: every line kept, every record read as the standard has it, spectacles made of it and written back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/oma_order.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "lenses/lens_io/oma_trace.hpp"
#include "tracking/input_error.hpp"

namespace {

using lenses::job_of;
using lenses::Lens;
using lenses::OmaOrder;
using lenses::read_order;
using lenses::Side;
using lenses::Spectacles;
using lenses::spectacles_of;
using lenses::io::OmaJob;
using lenses::io::parse_oma;

constexpr double kDegree = std::numbers::pi / 180.0;
// Lengths in mm and angles in degrees come through one multiplication.
constexpr double kExact = 1e-12;
constexpr std::size_t kRight = 0, kLeft = 1;

const std::string kSample = VERGENCE_ASSETS "/jobs/progressive_pair.oma";

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

OmaOrder order_of(const std::string& text) {
  return read_order(parse_oma(text, "t.oma"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(OmaJob, KeepsEveryByte) {
  for (const std::string& text : std::vector<std::string>{std::string(), std::string("A=1"),
                                                          std::string("A=1\r\nB=2\rC=\n\n_X= odd ; thing \nZ=?;;\n"),
                                                          std::string("\r\n\r\nJOB=a=b=c\r"), text_of(kSample)}) {
    EXPECT_EQ(parse_oma(text, "t").text(), text);
  }
}

TEST(OmaJob, FindsFields) {
  const OmaJob job = parse_oma("SPH=-1.75;+2\r\nAX= 170 \rIPD=?;31\nADD=;2\nDBL=18\nFOO=1;2;3\nSPHX=9\n", "t");
  EXPECT_EQ(job.number_of("SPH", Side::right, -9, 9), -1.75);
  EXPECT_EQ(job.number_of("SPH", Side::left, -9, 9), 2.0);
  EXPECT_EQ(job.number_of("AX", Side::right, 0, 180), 170.0);
  EXPECT_EQ(job.number_of("AX", Side::left, 0, 180), 170.0);  // a lone value serves both
  EXPECT_EQ(job.number_of("IPD", Side::right, 0, 99), std::nullopt);
  EXPECT_EQ(job.number_of("IPD", Side::left, 0, 99), 31.0);
  EXPECT_EQ(job.number_of("ADD", Side::right, 0, 9), std::nullopt);
  EXPECT_EQ(job.number_of("NONE", Side::left, 0, 9), std::nullopt);
}

TEST(OmaJob, SetsARecordInItsPlace) {
  OmaJob job = parse_oma("JOB=1\rSPH=1;2\rTRCFMT=1;8;E;R;F\r", "t");
  job.set("SPH", "3;4");
  job.set("CYL", "-1;?");
  EXPECT_EQ(job.text(), "JOB=1\rSPH=3;4\rCYL=-1;?\rTRCFMT=1;8;E;R;F\r");
  OmaJob open = parse_oma("JOB=1\nSPH=1", "t");
  open.set("CYL", "0");
  EXPECT_EQ(open.text(), "JOB=1\nSPH=1\nCYL=0\n");
}

TEST(OmaOrder, ReadsTheSample) {
  const OmaOrder order = order_of(text_of(kSample));
  const auto &right = order.eye[kRight], &left = order.eye[kLeft];
  EXPECT_TRUE(order.wanted[kRight] && order.wanted[kLeft]);
  ASSERT_TRUE(right.prescription && left.prescription);
  EXPECT_EQ(right.prescription->sphere, -1.75);
  EXPECT_EQ(left.prescription->cylinder, -0.75);
  EXPECT_NEAR(right.prescription->axis, 170.0 * kDegree, kExact);
  EXPECT_EQ(right.prescription->addition, 2.0);
  EXPECT_TRUE(right.prescription->prism.empty());
  ASSERT_EQ(left.prescription->prism.size(), 1U);
  EXPECT_EQ(left.prescription->prism[0].magnitude, 0.5);
  EXPECT_NEAR(left.prescription->prism[0].base, 90.0 * kDegree, kExact);
  EXPECT_NEAR(*right.far_pd, 0.032, kExact);
  EXPECT_NEAR(*left.near_pd, 0.029, kExact);
  EXPECT_NEAR(*left.fitting_height, 0.0205, kExact);
  EXPECT_EQ(left.optical_centre_height, std::nullopt);
  EXPECT_NEAR(*right.vertex_distance, 0.013, kExact);
  EXPECT_NEAR(*right.pantoscopic_tilt, 9.0 * kDegree, kExact);
  EXPECT_NEAR(*left.wrap, 5.0 * kDegree, kExact);
  EXPECT_EQ(right.index, 1.6);
  EXPECT_NEAR(*right.corridor_length, 0.014, kExact);
  EXPECT_NEAR(*order.bridge, 0.018, kExact);
  // Box arithmetic: (52 + 18)/2 - 32 = 3 mm in, that is to our -x of the right lens; 20 - 36/2 = 2 mm up.
  const glm::dvec2 in_right = pupil_in_box(order, Side::right, true), in_left = pupil_in_box(order, Side::left, true);
  EXPECT_LT(glm::distance(in_right, {-0.003, 0.002}), kExact);
  EXPECT_LT(glm::distance(in_left, {0.004, 0.0025}), kExact);
  ASSERT_EQ(right.outline.size(), 360U);
  // The trace's box is that of HBOX and VBOX, and goes round counter-clockwise.
  glm::dvec2 low(1.0), high(-1.0);
  double doubled_area = 0.0;
  for (std::size_t i = 0; i < 360; ++i) {
    const glm::dvec2 &a = right.outline[i], &b = right.outline[(i + 1) % 360];
    low = glm::min(low, a);
    high = glm::max(high, a);
    doubled_area += a.x * b.y - a.y * b.x;
  }
  EXPECT_GT(doubled_area, 0.0);
  EXPECT_NEAR(high.x - low.x, 0.052, 0.0015);
  EXPECT_NEAR(high.y - low.y, 0.036, 0.0015);
}

// The numbers of a real progressive job: the cross 4 mm above the blank's centre, the near point 13 mm below it.
TEST(OmaOrder, ReadsReferencePoints) {
  const OmaOrder order = order_of(
      "CORRLEN=17;17\nBCSGUP=4;4\nBCSGIN=0;0\nBCDRPUP=8;8\nBCNRPUP=-13;-13\nBCNRPIN=2.5;2.25\n"
      "LDDRSPH=-1.79;-2.31\nLDDRCYL=-0.52;-0.70\nLDDRAX=171;14\nLDNRSPH=0.11;-0.2\nLDADD=1.9;1.95\n");
  for (const std::size_t i : {kRight, kLeft}) {
    const auto& eye = order.eye[i];
    ASSERT_TRUE(eye.fitting_cross && eye.near_point && eye.corridor_length && eye.distance_point);
    EXPECT_NEAR(eye.fitting_cross->y - eye.near_point->y, *eye.corridor_length, kExact);
    EXPECT_NEAR(eye.distance_point->y, 0.008, kExact);
  }
  EXPECT_NEAR(order.eye[kRight].near_point->x, -0.0025, kExact);  // towards the nose
  EXPECT_NEAR(order.eye[kLeft].near_point->x, 0.00225, kExact);
  EXPECT_EQ(order.eye[kRight].designed->sphere, -1.79);
  EXPECT_EQ(order.eye[kLeft].designed->addition, 1.95);
  EXPECT_EQ(order.eye[kLeft].designed_near->sphere, -0.2);
}

TEST(OmaOrder, TellsRadiiFromDioptres) {
  const auto eye = [](const std::string& text) { return order_of(text).eye[kRight]; };
  EXPECT_NEAR(*eye("FRNT=88.0\n").front_curvature, 1.0 / 0.088, kExact);
  EXPECT_NEAR(*eye("BACK=119.25\n").back_curvature, 1.0 / 0.11925, kExact);
  EXPECT_NEAR(*eye("FRNT=6.25\n").front_curvature, 6.25 / 0.53, kExact);
  EXPECT_NEAR(*eye("BACK=-6.25\n").back_curvature, 6.25 / 0.53, kExact);  // a concave back has negative power
  EXPECT_NEAR(*eye("FRNT=6.25\nTIND=1.6\n").front_curvature, 6.25 / 0.6, kExact);
  EXPECT_EQ(eye("FRNT=0\n").front_curvature, 0.0);
}

TEST(OmaOrder, ReadsWhicheverWayTheStandardAllows) {
  EXPECT_TRUE(order_of("DO=R\n").wanted[kRight]);
  EXPECT_FALSE(order_of("DO=R\n").wanted[kLeft]);
  EXPECT_NEAR(*order_of("NWD=40\n").near_distance, 0.4, kExact);
  EXPECT_NEAR(*order_of("NWD=400\n").near_distance, 0.4, kExact);
  EXPECT_EQ(order_of("LTYPE=SV;BI\n").type[kRight], lenses::OmaLensType::single_vision);
  EXPECT_EQ(order_of("LTYPE=SV;BI\n").type[kLeft], lenses::OmaLensType::bifocal);
}

// Radius 0 at the viewer's right is our -x; then counter-clockwise for the viewer.
TEST(OmaTrace, RunsAsTheViewerSeesIt) {
  const std::string radii = "R=1000;1100;1200;1300;1400;1500;1600;1700\n";
  const OmaOrder order = order_of("TRCFMT=1;8;E;R;F\n" + radii);
  const auto& right = order.eye[kRight].outline;
  const auto has = [](const std::vector<glm::dvec2>& outline, glm::dvec2 at) {
    return std::ranges::any_of(outline, [&](const glm::dvec2& p) { return glm::distance(p, at) < kExact; });
  };
  EXPECT_TRUE(has(right, {-0.010, 0.0}));
  EXPECT_TRUE(has(right, {0.0, 0.012}));
  EXPECT_TRUE(has(right, {0.014, 0.0}));
  EXPECT_TRUE(has(right, {0.0, -0.016}));
  EXPECT_TRUE(has(order.eye[kLeft].outline, {0.010, 0.0}));  // only one eye traced: the other mirrors it
  const OmaOrder angles = order_of("TRCFMT=1;8;U;L;F\n" + radii + "A=0;4500;9000;13500;18000;22500;27000;31500\n");
  EXPECT_EQ(angles.eye[kLeft].outline, right);
}

TEST(OmaTrace, ComesBack) {
  const auto outline = order_of(text_of(kSample)).eye[kLeft].outline;
  std::string text;
  for (const std::string& line : lenses::io::trace_lines(outline, Side::left)) text.append(line).append("\n");
  const auto again = order_of(text).eye[kLeft].outline;
  ASSERT_EQ(again.size(), outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    EXPECT_LT(glm::distance(again[i], outline[i]), 1e-9);  // both are rounded to 0.01 mm
  }
}

TEST(OmaOrder, RefusesDamage) {
  struct Bad {
    std::string text, field, word;
  };
  const std::string trace = "TRCFMT=1;8;E;R;F\n";
  for (const Bad& bad : std::vector<Bad>{
           {"SPH\n", "line 1", "LABEL=value"},
           {"=3\n", "line 1", "LABEL=value"},
           {"S PH=3\n", "line 1", "LABEL=value"},
           {"JOB=1\nSPH=x\n", "line 2: SPH", "number from -50 to 50"},
           {"SPH=1;2;3\n", "line 1: SPH", "3 fields"},
           {"SPH=1\nSPH=2\n", "line 2: SPH", "twice"},
           {"SPH=nan\n", "line 1: SPH", "number"},
           {"SPH=1\nCYL=-1\n", "line 2: CYL", "without an axis"},
           {"SPH=1\nCYL=-1\nAX=190\n", "line 3: AX", "from 0 to 180"},
           {"IPD=63\n", "line 1: IPD", "from 10 to 50"},
           {"DO=X\n", "line 1: DO", "B, R or L"},
           {"R=1;2\n", "line 1: R", "before any TRCFMT"},
           {trace + "R=1000;1000\n", "line 1: TRCFMT", "announces 8"},
           {trace + "R=1;1;1;1;1;1;1;1\n", "line 2: R", "100 to 10000"},
           {trace + "R=1000;1000;1000;1000;1000;1000;1000;1000;1000\n", "line 2: R", "more numbers"},
           {"TRCFMT=4;8;E;R;F\n", "line 1: TRCFMT", "format"},
           {"TRCFMT=1;1000000000;E;R;F\n", "line 1: TRCFMT", "points"},
           {"TRCFMT=1;8;E;B;F\n", "line 1: TRCFMT", "R or L"},
           {"TRCFMT=1;8;X;R;F\n", "line 1: TRCFMT", "E or U"},
           {"TRCFMT=1;8\n", "line 1: TRCFMT", "few fields"},
       }) {
    SCOPED_TRACE(bad.text);
    try {
      (void)order_of(bad.text);
      ADD_FAILURE() << "was read";
    } catch (const tracking::InputError& error) {
      EXPECT_EQ(error.field(), bad.field) << error.what();
      EXPECT_NE(error.reason().find(bad.word), std::string::npos) << error.what();
    }
  }
}

lenses::design::PointPower read_at(const Lens& lens, const glm::dvec2& at) {
  const auto reading = lenses::design::reading_at_back(lenses::design::LensShape(lens), at);
  EXPECT_TRUE(reading.has_value());
  return reading.value_or(lenses::design::PointPower{});
}

// Distance of the outline's box centre from the pupil, and the powers, are what the job orders.
TEST(OmaSpectacles, AreWhatTheSampleOrders) {
  const Spectacles pair = spectacles_of(parse_oma(text_of(kSample), kSample)).spectacles;
  EXPECT_EQ(pair.name, "SAMPLE");
  for (const std::size_t i : {kRight, kLeft}) {
    SCOPED_TRACE(i);
    const Lens& lens = pair.lens[i];
    EXPECT_EQ(lens.index, 1.6);
    EXPECT_EQ(lens.abbe, 41.0);
    EXPECT_NEAR(lens.fit.pantoscopic_tilt, 9.0 * kDegree, kExact);
    ASSERT_TRUE(lens.reference_points.fitting_cross && lens.reference_points.near);
    EXPECT_LT(glm::distance(lens.fit.decentration, -*lens.reference_points.fitting_cross), kExact);
    EXPECT_NEAR(lens.reference_points.fitting_cross->y - lens.reference_points.near->y, 0.014, kExact);
    EXPECT_NEAR(lens.reference_points.near->x, i == kRight ? -0.002 : 0.002, kExact);  // IPD - NPD, to the nose
    glm::dvec2 low(1.0), high(-1.0);
    for (const glm::dvec2& point : lens.outline) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
    // The pupil lies 3 (left 4) mm in of the box's centre and 2 (2.5) mm above it; the trace's own box is off by the
    // spacing of its points.
    const glm::dvec2 pupil = *lens.reference_points.fitting_cross - 0.5 * (low + high);
    EXPECT_NEAR(pupil.x, i == kRight ? -0.003 : 0.004, 2e-5);
    EXPECT_NEAR(pupil.y, i == kRight ? 0.002 : 0.0025, 2e-5);
    ASSERT_TRUE(lens.order);
    EXPECT_EQ(lens.order->ordered.sphere, i == kRight ? -1.75 : -2.25);
  }
}

TEST(OmaSpectacles, TakeTheSurfacesOfTheJob) {
  const std::string job =
      "SPH=0;0\nCYL=0;0\nADD=2;2\nLIND=1.6\nCTHICK=2\nBACK=119.25\nBCSGUP=4\nBCDRPUP=8\nBCNRPUP=-12\n"
      "BCNRPIN=2\n" +
      text_of(VERGENCE_ASSETS "/lenses/progressive_add200_right.sdf");
  const auto made = spectacles_of(parse_oma(replaced(job, "ADD=2;2\n", "ADD=2;2\nDO=R\n"), "t.oma"));
  const auto& right = made.lens[kRight];
  EXPECT_EQ(right.front.kind, lenses::SurfaceOrigin::Kind::tabulated);
  EXPECT_EQ(right.back.kind, lenses::SurfaceOrigin::Kind::radius);
  EXPECT_LT(right.front.fit->residual_rms, 1e-9);
  EXPECT_EQ(std::get<lenses::Sphere>(right.lens.back).curvature, 1e3 / 119.25);
  EXPECT_FALSE(made.lens[kLeft].made);
  // The stored lens of the same surface; both are within 0.04 D of it.
  const Lens stored = lenses::read_lens(VERGENCE_TEST_DATA "/progressive_add200_right.json");
  for (const glm::dvec2 at : {glm::dvec2(0.0, 0.008), glm::dvec2(-0.002, -0.012), glm::dvec2(0.01, 0.0)}) {
    const auto a = read_at(right.lens, at), b = read_at(stored, at);
    for (const int k : {0, 1, 2, 3}) EXPECT_NEAR(a.power[k / 2][k % 2], b.power[k / 2][k % 2], 0.02);
  }
}

// Only one surface given: the other is solved for, so that a lensmeter reads the order.
TEST(OmaSpectacles, SolveForTheSurfaceThatIsMissing) {
  const std::string surface = text_of(VERGENCE_ASSETS "/lenses/progressive_add200_right.sdf");
  const std::string order =
      "DO=R\nSPH=-1.25\nCYL=-0.75\nAX=20\nADD=2\nPRVM=1\nPRVA=90\nLIND=1.6\nBCSGUP=4\nBCDRPUP=8\n";
  const auto made = spectacles_of(parse_oma(order + surface, "t.oma"));
  const Lens& lens = made.lens[kRight].lens;
  EXPECT_EQ(made.lens[kRight].back.kind, lenses::SurfaceOrigin::Kind::prescription);
  const auto read = lenses::design::to_prescription(read_at(lens, {0.0, 0.008}), false);
  EXPECT_NEAR(read.sphere, -1.25, 1e-6);
  EXPECT_NEAR(read.cylinder, -0.75, 1e-6);
  EXPECT_NEAR(read.axis, 20.0 * kDegree, 1e-6);
  const glm::dvec2 prism = read_at(lens, {0.0, 0.0}).prism;
  EXPECT_NEAR(prism.x, 0.0, 1e-6);
  EXPECT_NEAR(prism.y, 1.0, 1e-6);
}

TEST(OmaSpectacles, TakeRadiiAsTheyAre) {
  const auto made = spectacles_of(parse_oma("FRNT=90;95\nBACK=150;140\nLIND=1.5\nCTHICK=3;3.5\n", "t.oma"));
  const Lens& left = made.lens[kLeft].lens;
  EXPECT_EQ(std::get<lenses::Sphere>(left.front).curvature, 1e3 / 95.0);
  EXPECT_EQ(std::get<lenses::Sphere>(left.back).curvature, 1e3 / 140.0);
  EXPECT_NEAR(left.centre_thickness, 0.0035, kExact);
  EXPECT_FALSE(left.order);
}

TEST(OmaSpectacles, NameTheRecordThatForbidsTheLens) {
  struct Bad {
    std::string text, field;
  };
  for (const Bad& bad : std::vector<Bad>{{"JOB=1\n", "SPH"},
                                         {"SPH=-4\nCTHICK=0.1\n", "line 2: CTHICK"},
                                         {"SPH=-4\nADD=5\n", "line 2: ADD"},
                                         {"LIND=1.6\nSPH=1\nADD=2\nCORRLEN=25\n", "line 4: CORRLEN"}}) {
    try {
      (void)spectacles_of(parse_oma(bad.text, "t.oma"));
      ADD_FAILURE() << bad.text;
    } catch (const tracking::InputError& error) {
      EXPECT_EQ(error.field(), bad.field) << error.what();
    }
  }
}

// What has not changed is not touched: unknown records, spelling, order, line ends.
TEST(OmaWriter, LeavesAnUnchangedJobAsItWas) {
  std::string crlf = text_of(kSample);
  for (std::size_t at = 0; (at = crlf.find('\n', at)) != std::string::npos; at += 2) crlf.insert(at, 1, '\r');
  for (const std::string& text : {text_of(kSample), crlf}) {
    const OmaJob job = parse_oma(text, "t.oma");
    // By way of the file, as a user would.
    const Spectacles pair = lenses::parse_spectacles(to_json(spectacles_of(job).spectacles), "t.json");
    EXPECT_EQ(job_of(pair, "t.json", {.base = job}).text(), text);
  }
}

TEST(OmaWriter, ChangesWhatHasChanged) {
  const OmaJob job = parse_oma(text_of(kSample), "t.oma");
  Spectacles pair = spectacles_of(job).spectacles;
  pair.lens[kRight].fit.vertex_distance = 0.0145;
  for (glm::dvec2& point : pair.lens[kLeft].outline) point += glm::dvec2(0.0, -0.001);  // cut 1 mm lower
  pair.lens[kLeft].order->ordered.prism = {{1.0, 0.0}};
  std::string expected = replaced(text_of(kSample), "BVD=13.00;13.00", "BVD=14.5;13");
  expected = replaced(expected, "SEGHT=20.00;20.50", "SEGHT=20;21.5");
  expected = replaced(expected, "PRVM=0.00;0.50", "PRVM=0;1");
  expected = replaced(expected, "PRVA=0;90", "PRVA=0;0");
  EXPECT_EQ(job_of(pair, "t.json", {.base = job}).text(), expected);
}

// A job of a frame alone gets the lenses; what it said already stays.
TEST(OmaWriter, CompletesAJobOfAFrame) {
  const std::string frame = "JOB=7\nDBL=20\nTRCFMT=1;8;E;R;F\nR=2600;2500;2000;2500;2600;2500;2000;2500\n";
  const Spectacles pair = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/myopia.json");
  const std::string text = job_of(pair, "t.json", {.base = parse_oma(frame, "t.oma")}).text();
  EXPECT_TRUE(text.starts_with("JOB=7\nDBL=20\n"));
  EXPECT_NE(text.find("\nCTHICK=1.2;1.2\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with(frame.substr(frame.find("TRCFMT")))) << text;
}

// A new job of any spectacles reads back as the same lenses, as far as tables hold them.
TEST(OmaWriter, MakesAJobOfSpectacles) {
  for (const std::string name : {"presbyopia_bspline_torus", "myopia", "astigmatism"}) {
    SCOPED_TRACE(name);
    Spectacles pair = lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/" + name + ".json");
    for (const std::size_t i : {kRight, kLeft}) {
      pair.lens[i].outline = order_of(text_of(kSample)).eye[i].outline;
      pair.lens[i].fit.wrap = 5.0 * kDegree;
    }
    const std::string text = job_of(pair, "t.json").text();
    const Spectacles again = spectacles_of(parse_oma(text, "t.oma")).spectacles;
    for (const std::size_t i : {kRight, kLeft}) {
      const Lens &a = pair.lens[i], &b = again.lens[i];
      EXPECT_NEAR(a.centre_thickness, b.centre_thickness, 1e-7);
      EXPECT_NEAR(a.fit.wrap, b.fit.wrap, 1e-6);
      EXPECT_LT(glm::distance(a.fit.decentration, b.fit.decentration), 1e-6);
      for (const glm::dvec2 at : {glm::dvec2(0.0, 0.008), glm::dvec2(0.002, -0.01), glm::dvec2(0.015, 0.0)}) {
        const auto x = read_at(a, at), y = read_at(b, at);
        for (const int k : {0, 1, 2, 3}) EXPECT_NEAR(x.power[k / 2][k % 2], y.power[k / 2][k % 2], 0.02);
      }
      for (std::size_t k = 0; k < 360; k += 30) EXPECT_LT(glm::distance(a.outline[k], b.outline[k]), 5e-5);
    }
  }
}

}  // namespace
