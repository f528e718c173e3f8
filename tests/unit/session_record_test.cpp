// A recorded session: both files as they are while it runs, read back bit for bit, and refused by field.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "app/recording/session_recorder.hpp"
#include "app/recording/session_replay.hpp"
#include "tracking/input_error.hpp"

namespace {

using app::RecordedView;
using app::SessionRecord;
using app::SessionRecorder;
using app::SessionReplay;
using nlohmann::json;
using tracking::InputError;

class SessionRecordTest : public testing::Test {
 protected:
  SessionRecordTest() { std::filesystem::create_directories(folder_); }
  ~SessionRecordTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static RecordedView random_view(std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    RecordedView view;
    view.head_from_view.position = {unit(random), unit(random), unit(random)};
    view.head_from_view.orientation =
        glm::normalize(glm::dquat(unit(random), unit(random), unit(random), unit(random)));
    view.fov = {1.0 + 0.5 * unit(random), 1.0, 1.0 / 3.0, 0.9};
    return view;
  }
  static void expect_same(const RecordedView& a, const RecordedView& b) {
    EXPECT_EQ(a.head_from_view.position, b.head_from_view.position);
    EXPECT_EQ(a.head_from_view.orientation, b.head_from_view.orientation);
    EXPECT_EQ(a.fov.tan_left, b.fov.tan_left);
    EXPECT_EQ(a.fov.tan_down, b.fov.tan_down);
  }
  static tracking::TraceRow row_at(double time) {
    tracking::TraceRow row;
    row.time = time;
    row.eyes = tracking::EyesInFrame{{0.003, 0.0031}, {1.25, 1.0}};
    row.source = tracking::GazeSource::tracker;
    return row;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("session_record_test." + std::to_string(::getpid()));
};

TEST_F(SessionRecordTest, WhatWasRecordedComesBack) {
  std::mt19937_64 random(3);
  const std::array first{random_view(random), random_view(random)}, second{random_view(random), first[1]};
  const std::string file = path("walk.csv");
  {
    SessionRecorder recorder(file, {"a device", {640, 480}, {{"scene", "x.glb"}, {"mode", "adof"}}, {}, {}, {}, {}});
    for (int i = 0; i < 30; ++i) {
      if (i == 10) recorder.event(0.099, "spectacles on");
      if (i == 10) recorder.event(0.099, "recentred");
      ASSERT_TRUE(recorder.frame(row_at(0.01 * i), i < 20 ? first : second, i < 5 ? "standard" : "coarse",
                                 i < 10 ? "none" : "A",
                                 i < 10   ? app::ShownChange{0, {2}, "adof"}
                                 : i < 25 ? app::ShownChange{0, {0, 1}, "adof"}
                                          : app::ShownChange{0, {0, 1}, "power"}));
    }
    EXPECT_FALSE(recorder.frame(row_at(0.0), second, "coarse", "A")) << "time must increase";
    EXPECT_EQ(recorder.frames(), 30U);
  }
  const SessionReplay replay(file);
  ASSERT_EQ(replay.frames(), 30U);
  ASSERT_TRUE(replay.record());
  EXPECT_EQ(replay.record()->device, "a device");
  EXPECT_EQ(replay.record()->size, (std::array{640, 480}));
  EXPECT_EQ(replay.record()->views.size(), 2U) << "only what changed is kept";
  EXPECT_EQ(replay.record()->options.size(), 2U);
  for (std::size_t i = 0; i < 30; ++i) {
    const auto frame = replay.frame(i);
    EXPECT_EQ(frame.row->time, 0.01 * static_cast<double>(i));
    EXPECT_EQ(frame.row->eyes->pupil_diameter[1], 0.0031);
    expect_same((*frame.views)[0], (i < 20 ? first : second)[0]);
    expect_same((*frame.views)[1], first[1]);
    EXPECT_EQ(*frame.rung, i < 5 ? "standard" : "coarse");
    EXPECT_EQ(*frame.pair, i < 10 ? "none" : "A");
    EXPECT_EQ(frame.shown->pairs, i < 10 ? (std::vector<std::size_t>{2}) : (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(frame.shown->picture, i < 25 ? "adof" : "power");
    EXPECT_EQ(replay.events_before(i).size(), i == 10 ? 2U : 0U);
  }
  EXPECT_EQ(replay.record()->shown.size(), 3U);
  EXPECT_EQ(replay.events_before(10)[1].what, "recentred");
}

// As a crash would leave them: both files can be read after every frame.
TEST_F(SessionRecordTest, ACrashLosesNothing) {
  std::mt19937_64 random(4);
  const std::string file = path("crash.csv");
  SessionRecorder recorder(file, {});
  for (int i = 0; i < 20; ++i) {
    recorder.event(0.01 * i, "key " + std::to_string(i));
    ASSERT_TRUE(
        recorder.frame(row_at(0.01 * i), {random_view(random), random_view(random)}, "r" + std::to_string(i / 3), "A"));
    const SessionReplay replay(file);
    ASSERT_EQ(replay.frames(), static_cast<std::size_t>(i + 1));
    EXPECT_EQ(*replay.frame(static_cast<std::size_t>(i)).rung, "r" + std::to_string(i / 3));
    EXPECT_EQ(replay.events_before(static_cast<std::size_t>(i)).size(), 1U);
  }
  // An event whose frame never came, and a line that was cut.
  recorder.event(0.3, "the end");
  std::ofstream(file, std::ios::app) << "0.31,0,0";
  const SessionReplay replay(file);
  EXPECT_EQ(replay.frames(), 20U);
  EXPECT_TRUE(replay.last_line_cut());
  EXPECT_EQ(replay.events_before(20)[0].what, "the end");
}

TEST_F(SessionRecordTest, ATraceAloneIsEnough) {
  const std::string example = std::string(VERGENCE_ASSETS) + "/traces/glance_at_card.csv";
  std::filesystem::copy_file(example, path("alone.csv"));
  const SessionReplay alone(path("alone.csv"));
  EXPECT_FALSE(alone.record());
  EXPECT_EQ(alone.frame(3).views, nullptr);
  EXPECT_EQ(alone.frame(3).rung, nullptr);
  EXPECT_EQ(alone.frame(3).shown, nullptr);
  const SessionReplay with_record(example);
  ASSERT_TRUE(with_record.record());
  EXPECT_EQ(*with_record.frame(44).pair, "none");
  EXPECT_EQ(*with_record.frame(45).pair, "A");
  EXPECT_EQ(with_record.events_before(45).size(), 1U);
}

TEST_F(SessionRecordTest, NamesTheFieldOfEveryError) {
  std::ifstream stream(std::string(VERGENCE_ASSETS) + "/traces/glance_at_card.csv.json");
  const json good = json::parse(stream);
  struct Change {
    const char* pointer;
    const char* value;
    const char* field;
    const char* reason;
  };
  for (const Change& change : std::vector<Change>{
           {"/version", "2", "version", "newer than this program reads"},
           {"/rung", "1", "rung", "allowed: device, size_px, options, views, rungs, pairs, events"},
           {"/size_px", "[1]", "size_px", "2"},
           {"/size_px/0", "0.5", "size_px[0]", "a whole number is needed"},
           {"/options/scene", "3", "options.scene", "a string"},
           {"/options", "[]", "options", "an object of strings"},
           {"/views/0/frame", "-1", "views[0].frame", "from 0 to 4e+06"},
           {"/views/0/frame", "1.5", "views[0].frame", "a whole number is needed"},
           {"/views/0/left", "3", "views[0].left", "object"},
           {"/views/0/left/position_m", "[0, 0]", "views[0].left.position_m", "3"},
           {"/views/0/left/position_m/1", "11", "views[0].left.position_m[1]", "from -10 to 10"},
           {"/views/0/left/orientation_xyzw", "[0, 0, 0, 0]", "views[0].left.orientation_xyzw", "unit quaternion"},
           {"/views/0/right/fov_tan", "[1, -1, 1, 1]", "views[0].right.fov_tan", "empty field of view"},
           {"/views/0/right/fov_deg", "90", "views[0].right.fov_deg", "allowed: position_m, orientation_xyzw, fov_tan"},
           {"/rungs/0/name", "\"\"", "rungs[0].name", "is empty"},
           {"/pairs/1/frame", "\"x\"", "pairs[1].frame", "must be a number"},
           {"/pairs/0/frame", "50", "pairs[1].frame", "before the entry above it"},
           {"/events/0/time_s", "null", "events[0].time_s", "null"},
           {"/shown", R"([{"frame": 0, "pairs": [], "picture": "adof"}])", "shown[0].pairs", "1"},
           {"/shown", R"([{"frame": 0, "pairs": [0, 1, 2], "picture": "adof"}])", "shown[0].pairs", "2"},
           {"/shown", R"([{"frame": 0, "pairs": [64], "picture": "adof"}])", "shown[0].pairs[0]", "from 0 to 63"},
           {"/shown", R"([{"frame": 0, "pairs": [0], "picture": ""}])", "shown[0].picture", "is empty"},
           {"/shown", R"([{"frame": 0, "pairs": [0], "map": ""}])", "shown[0].map", "allowed: frame, pairs, picture"},
           {"/events/0/what", "1", "events[0].what", "allowed: frame, time_s, event"},
       }) {
    SCOPED_TRACE(change.pointer);
    json document = good;
    document[json::json_pointer(change.pointer)] = json::parse(change.value);
    try {
      static_cast<void>(app::parse_session_record(document.dump(), "f.json"));
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), change.field) << error.what();
      EXPECT_NE(error.reason().find(change.reason), std::string::npos) << error.reason();
    }
  }
}

TEST_F(SessionRecordTest, TheRecordMustFitItsTrace) {
  const tracking::GazeTrace trace{{row_at(0.0), row_at(0.1)}, false};
  const auto refused = [&](const SessionRecord& record, const std::string& field) {
    try {
      const SessionReplay replay(trace, record, "f.json");
      ADD_FAILURE() << "was taken";
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), field);
    }
  };
  SessionRecord late;
  late.rungs = {{1, "standard"}};
  refused(late, "rungs[0].frame");
  SessionRecord beyond;
  beyond.pairs = {{0, "A"}, {3, "B"}};
  refused(beyond, "pairs[1].frame");
  SessionRecord good;
  good.pairs = {{0, "A"}, {2, "B"}};
  const SessionReplay replay(trace, good, "f.json");
  EXPECT_EQ(*replay.frame(1).pair, "A");
}

TEST_F(SessionRecordTest, APlaceThatCannotBeWrittenIsSaid) {
  EXPECT_THROW(SessionRecorder(path("no/folder/a.csv"), {}), std::runtime_error);
}

}  // namespace
