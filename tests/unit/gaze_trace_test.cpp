// Recorded traces: what is written reads back bit for bit, what is not understood is refused by line and column.
#include "tracking/gaze_trace.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include "tracking/input_error.hpp"

namespace {

using tracking::GazeTrace;
using tracking::GazeTraceWriter;
using tracking::InputError;
using tracking::Side;
using tracking::TraceRow;

const std::string kHeader =
    "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,right_gy,right_gz,"
    "gaze_valid";
const std::string kRow = "0,0,1.6,0,0,0,0,1,0,0,-1,0,0,-1,1";

GazeTrace parse(const std::string& text) {
  return tracking::parse_gaze_trace(text, "f.csv");
}

void expect_refused(const std::string& text, const std::string& field, const std::string& reason) {
  try {
    static_cast<void>(parse(text));
    ADD_FAILURE() << "was read; expected " << field << ": " << reason;
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "f.csv");
    EXPECT_EQ(error.field(), field) << error.what();
    EXPECT_NE(error.reason().find(reason), std::string::npos) << error.reason() << "\nlacks: " << reason;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

// kRow with one field replaced.
std::string with(std::size_t column, const std::string& text) {
  std::stringstream in(kRow);
  std::string out, field;
  for (std::size_t i = 0; std::getline(in, field, ','); ++i) out += (i == 0 ? "" : ",") + (i == column ? text : field);
  return kHeader + "\n" + out + "\n";
}

class GazeTraceFile : public testing::Test {
 protected:
  GazeTraceFile() { std::filesystem::create_directories(folder_); }
  ~GazeTraceFile() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("gaze_trace_test." + std::to_string(::getpid()));
};

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void expect_same(const TraceRow& a, const TraceRow& b) {
  EXPECT_TRUE(same_bits(a.time, b.time));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(same_bits(a.head.position[i], b.head.position[i]));
    EXPECT_TRUE(same_bits(a.gaze[0][i], b.gaze[0][i]));
    EXPECT_TRUE(same_bits(a.gaze[1][i], b.gaze[1][i]));
  }
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(same_bits(a.head.orientation[i], b.head.orientation[i]));
  EXPECT_EQ(a.gaze_valid, b.gaze_valid);
  EXPECT_EQ(a.eyes, b.eyes);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.second, b.second);
}

TEST_F(GazeTraceFile, ReadsBackBitForBit) {
  constexpr std::uint64_t kSeed = 99;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  std::vector<TraceRow> rows;
  const std::string file = path("a.csv");
  {
    GazeTraceWriter writer(file, {.second = true});
    for (int i = 0; i < 500; ++i) {
      TraceRow row;
      row.time = 1e-3 * i + 1e-7 * unit(random);
      row.head.position = vector() * std::pow(10.0, 4.0 * unit(random));
      row.head.orientation = glm::normalize(glm::dquat(unit(random), unit(random), unit(random), unit(random)));
      // Now and then a unit vector of float32, as a runtime gives them.
      row.gaze = {glm::normalize(vector()), glm::dvec3(glm::vec3(glm::normalize(vector())))};
      row.gaze_valid = i % 7 != 0;
      row.eyes = tracking::EyesInFrame{{2e-3 + 1e-3 * unit(random), 3e-3}, {2.0 + unit(random), 1e-9}};
      row.source = i % 7 != 0 ? tracking::GazeSource::tracker : tracking::GazeSource::held;
      if (i % 3 == 0) {  // a second pair comes and goes
        row.second =
            tracking::EyesBehindSecond{{glm::normalize(vector()), glm::normalize(vector())}, {0.0, 2.0 + unit(random)}};
      }
      ASSERT_TRUE(writer.write(row));
      rows.push_back(row);
      // Each line is with the system as soon as it is written.
      if (i % 100 == 50) {
        EXPECT_EQ(tracking::read_gaze_trace(file).rows.size(), rows.size());
      }
    }
    EXPECT_EQ(writer.rows(), 500U);
  }
  const GazeTrace trace = tracking::read_gaze_trace(file);
  ASSERT_EQ(trace.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "row " << i << ", seed " << kSeed);
    expect_same(trace.rows[i], rows[i]);
  }
}

TEST_F(GazeTraceFile, TheFormatIsTheOneThatIsNamed) {
  GazeTraceWriter writer(path("b.csv"), {.eyes = false, .source = false});
  TraceRow row;
  row.time = 0.25;
  row.head = {glm::dquat(1.0, 0.0, 0.0, 0.0), {0.0, 1.6, -0.5}};
  row.gaze = {glm::dvec3(0.6, 0.0, -0.8), glm::dvec3(0.0, -0.6, -0.8)};  // right, left
  ASSERT_TRUE(writer.write(row));
  EXPECT_EQ(text_of(path("b.csv")), kHeader + "\n0.25,0,1.6,-0.5,0,0,0,1,0,-0.6,-0.8,0.6,0,-0.8,1\n");
}

TEST_F(GazeTraceFile, TheWriterTakesOnlyWhatCanBeRead) {
  GazeTraceWriter writer(path("c.csv"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TraceRow good;
  good.time = 1.0;
  EXPECT_TRUE(writer.write(good));
  EXPECT_FALSE(writer.write(good)) << "the same time again";
  const auto refused = [&](const std::function<void(TraceRow&)>& spoil) {
    TraceRow row = good;
    row.time = 2.0;
    spoil(row);
    EXPECT_FALSE(writer.write(row));
  };
  refused([&](TraceRow& r) { r.time = nan; });
  refused([&](TraceRow& r) { r.head.position.y = nan; });
  refused([&](TraceRow& r) { r.head.position.x = 2e5; });
  refused([&](TraceRow& r) { r.head.orientation = glm::dquat(0.0, 0.0, 0.0, 0.0); });
  refused([&](TraceRow& r) { r.gaze[1] = {0.0, 0.0, 0.0}; });
  refused([&](TraceRow& r) { r.gaze[0].x = std::numeric_limits<double>::infinity(); });
  refused([&](TraceRow& r) { r.second = tracking::EyesBehindSecond{}; });
  refused([&](TraceRow& r) { r.eyes = tracking::EyesInFrame{{nan, 0.003}, {}}; });
  EXPECT_EQ(tracking::read_gaze_trace(path("c.csv")).rows.size(), 1U);
  EXPECT_THROW(GazeTraceWriter(path("no/such/folder.csv")), std::runtime_error);
}

TEST(GazeTraceReader, ReadsWhatOthersWrite) {
  const std::string row = "1.5, 0,1.6,0, 0,0,0,1, 0,0,-2,0,0.6,-0.8,1";
  const GazeTrace trace = parse("\xEF\xBB\xBF" + kHeader + ",comment,pupil\r\n" + kRow + ",\"a, b\",\r\n" + row +
                                ",x,3.5");  // no line end at the file's end
  ASSERT_EQ(trace.rows.size(), 2U);
  EXPECT_FALSE(trace.last_line_cut);
  EXPECT_EQ(trace.rows[1].time, 1.5);
  EXPECT_EQ(trace.rows[1].gaze[static_cast<std::size_t>(Side::left)], glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(trace.rows[1].gaze[static_cast<std::size_t>(Side::right)], glm::dvec3(0.0, 0.6, -0.8));
  EXPECT_FALSE(trace.rows[1].eyes);
  EXPECT_FALSE(trace.rows[1].source);
  // A blink says nothing of the direction.
  EXPECT_EQ(parse(kHeader + "\n0,0,0,0,0,0,0,1,0,0,0,0,0,0,0\n").rows[0].gaze[0], glm::dvec3(0.0));
  // A quaternion of few decimals is normalised.
  const auto q = parse(with(4, "0.0002")).rows[0].head.orientation;
  EXPECT_TRUE(same_bits(q.w, 1.0)) << "within float32's rounding, as it is";
  const auto rounded = parse(kHeader + "\n0,0,0,0,0.707,0,0,0.707,0,0,-1,0,0,-1,1\n").rows[0].head.orientation;
  EXPECT_NEAR(glm::length(rounded), 1.0, 1e-15);
}

TEST(GazeTraceReader, ALineThatWasCutIsLeftOut) {
  const GazeTrace trace = parse(kHeader + "\n" + kRow + "\n0.1,0,1.6,0,0,0,");
  EXPECT_TRUE(trace.last_line_cut);
  EXPECT_EQ(trace.rows.size(), 1U);
  expect_refused(kHeader + "\n" + kRow + "\n0.1,0,1.6,0,0,0,\n", "line 3", "has 7 fields; the header names 15");
}

TEST(GazeTraceReader, NamesLineAndColumn) {
  expect_refused("", "", "is empty");
  expect_refused(kHeader + "\n", "", "has no rows");
  expect_refused("time,x\n", "line 1", "has 'time' where time_s is expected");
  expect_refused("time_s,head_px\n", "line 1", "ends where head_py is expected");
  expect_refused(kHeader + ",left_pupil_m\n" + kRow + ",1\n", "line 1", "all four or none");
  expect_refused(kHeader + ",gaze_source,gaze_source\n", "line 1: gaze_source", "given twice");
  expect_refused(kHeader + ",head_px\n", "line 1: head_px", "given twice");
  expect_refused(with(0, "soon"), "line 2: time_s", "'soon' is not a number");
  expect_refused(with(1, ""), "line 2: head_px", "is empty");
  expect_refused(with(2, "1.6m"), "line 2: head_py", "'1.6m' is not a number");
  expect_refused(with(3, "nan"), "line 2: head_pz", "is not finite");
  expect_refused(with(3, "-inf"), "line 2: head_pz", "is not finite");
  expect_refused(with(3, "1e999"), "line 2: head_pz", "is not finite");
  expect_refused(with(3, "2e5"), "line 2: head_pz", "from -100000 to 100000");
  expect_refused(with(7, "0"), "line 2: head_qx", "have the length 0; a unit quaternion");
  expect_refused(with(7, "1.01"), "line 2: head_qx", "have the length 1.01");
  expect_refused(with(10, "0"), "line 2: left_gx", "must point somewhere");
  expect_refused(with(13, "0"), "line 2: right_gx", "must point somewhere");
  expect_refused(with(14, "2"), "line 2: gaze_valid", "'2' is not allowed; 0 or 1");
  expect_refused(with(14, "true"), "line 2: gaze_valid", "0 or 1");
  expect_refused(kHeader + "\n" + kRow + "\n\n" + kRow + "\n", "line 4: time_s", "not later than the row before");
  expect_refused(kHeader + "\n" + kRow + ",9\n", "line 2", "has 16 fields");
  const std::string eyes =
      kHeader + ",left_pupil_m,right_pupil_m,left_accommodation_D,right_accommodation_D,gaze_source\n" + kRow;
  EXPECT_EQ(parse(eyes + ",0.003,0.004,1,2,held\n").rows[0].eyes->pupil_diameter[0], 0.004);
  expect_refused(eyes + ",3,0.004,1,2,held\n", "line 2: left_pupil_m", "from 0 to 0.02");
  expect_refused(eyes + ",0.003,0.004,1,-2,held\n", "line 2: right_accommodation_D", "from 0 to 50");
  expect_refused(eyes + ",0.003,0.004,1,2,guess\n", "line 2: gaze_source", "tracker, held or head");
  const std::string second = kHeader +
                             ",b_left_gx,b_left_gy,b_left_gz,b_right_gx,b_right_gy,b_right_gz,b_left_accommodation_D,"
                             "b_right_accommodation_D\n" +
                             kRow;
  EXPECT_EQ(parse(second + ",0,0,-1,0,0.6,-0.8,1,2\n").rows[0].second->gaze[0].y, 0.6);
  EXPECT_FALSE(parse(second + ",0,0,0,0,0,0,0,0\n").rows[0].second);
  expect_refused(second + ",0,0,-1,0,0,0,1,2\n", "line 2: b_right_gx", "must point somewhere");
  expect_refused(second + ",0,0,-1,0,0,x,1,2\n", "line 2: b_right_gz", "not a number");
  expect_refused(second + ",0,0,-1,0,0,-1,1,51\n", "line 2: b_right_accommodation_D", "from 0 to 50");
  expect_refused(kHeader + ",b_left_gx\n" + kRow + ",0\n", "line 1", "all eight or none");
  expect_refused(std::string(10000, 'x'), "line 1", "is longer than 8192");
}

TEST_F(GazeTraceFile, FilesThatAreNoTraces) {
  EXPECT_THROW(static_cast<void>(tracking::read_gaze_trace(path("none.csv"))), InputError);
  EXPECT_THROW(static_cast<void>(tracking::read_gaze_trace(path(""))), InputError);
  // Without an end, and without a line: refused at once, not read into memory.
  EXPECT_THROW(static_cast<void>(tracking::read_gaze_trace("/dev/zero")), InputError);
}

TEST(GazeTraceReader, TheExampleIsATrace) {
  const GazeTrace trace = tracking::read_gaze_trace(std::string(VERGENCE_ASSETS) + "/traces/glance_at_card.csv");
  EXPECT_GT(trace.rows.size(), 60U);
  EXPECT_FALSE(trace.last_line_cut);
  bool blinks = false;
  for (const TraceRow& row : trace.rows) blinks = blinks || !row.gaze_valid;
  EXPECT_TRUE(blinks);
}

}  // namespace
