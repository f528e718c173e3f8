// Gaze from a source of the layer to our own client, through the real loader and a real Monado, and on to the lens.
#include "xr/gaze_input.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <functional>
#include <glm/geometric.hpp>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/trace.hpp"
#include "tests/support/gaze_traces.hpp"
#include "tests/support/gaze_wearer.hpp"

namespace {

using support::gaze_row;
using support::GazeWearer;
using support::kFloatPose;
using support::nanoseconds;
using support::yaw;
using tracking::Side;

constexpr auto kRight = static_cast<std::size_t>(Side::right), kLeft = static_cast<std::size_t>(Side::left);

class GazeInput : public testing::Test {
 protected:
  GazeInput() { support::enable_layers(support::kGazeLayer); }
  support::Monado monado_;
};

// Two eyes on a point at 40 cm, then far away.
const glm::dvec3 kPoint(0.1, -0.2, -0.4);
const glm::dvec3 kRightEye(0.0315, 0.0, 0.0), kLeftEye(-0.0315, 0.0, 0.0);

std::string near_then_far() {
  return gaze_row(0.0, kPoint - kLeftEye, kPoint - kRightEye) + gaze_row(0.5, yaw(5), yaw(5));
}

TEST_F(GazeInput, HasEachEyesOwnDirectionAtItsTime) {
  const support::TraceFile trace(monado_, near_then_far());
  GazeWearer wearer;
  EXPECT_FALSE(wearer.read(wearer.now()).valid) << "before the focus";
  wearer.wait_for_focus();
  const XrTime start = wearer.now();
  const auto first = wearer.read(start);
  ASSERT_TRUE(first.valid && first.eye[kRight] && first.eye[kLeft]);
  EXPECT_LT(glm::length(*first.eye[kRight] - glm::normalize(kPoint - kRightEye)), kFloatPose);
  EXPECT_LT(glm::length(*first.eye[kLeft] - glm::normalize(kPoint - kLeftEye)), kFloatPose);
  EXPECT_DOUBLE_EQ(first.time.value(), xr::seconds(start));
  const auto late = wearer.read(start + nanoseconds(0.4));
  EXPECT_DOUBLE_EQ(late.time.value(), xr::seconds(start)) << "an old sample says how old it is";
  const auto second = wearer.read(start + nanoseconds(0.5));
  EXPECT_LT(glm::length(*second.eye[kRight] - yaw(5)), kFloatPose);
  EXPECT_DOUBLE_EQ(second.time.value(), xr::seconds(start + nanoseconds(0.5)));
}

TEST_F(GazeInput, HasOneLineWhereEyesOfTheirOwnAreNotOffered) {
  const support::TraceFile trace(monado_, near_then_far());
  GazeWearer wearer({XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME});
  wearer.wait_for_focus();
  const auto sample = wearer.read(wearer.now());
  ASSERT_TRUE(sample.valid && sample.combined);
  EXPECT_FALSE(sample.eye[kRight] || sample.eye[kLeft]);
  // From between the eyes to the point that both look at, wherever it lies.
  EXPECT_LT(glm::length(sample.combined->direction - glm::normalize(kPoint)), kFloatPose);
  EXPECT_LT(glm::length(sample.combined->origin), kFloatPose);
  EXPECT_TRUE(sample.time);
}

TEST_F(GazeInput, HasNoSampleWithoutATracker) {
  GazeWearer wearer;  // the layer is there, and has no source
  wearer.wait_for_focus();
  EXPECT_FALSE(wearer.input->read(wearer.view, wearer.now()));
}

// The trace at 50 rows a second as a frame loop sees it; the source that the user is told goes along.
TEST_F(GazeInput, HoldsThroughABlinkAndGoesBackToTheHead) {
  std::string rows;
  for (int i = 0; i <= 50; ++i) {
    rows += gaze_row(0.02 * i, yaw(15), yaw(15), i < 10 || i > 20);  // a blink from 0.2 to 0.42 s
  }
  setenv("VERGENCE_GAZE_END", "stop", 1);
  const support::TraceFile trace(monado_, rows);
  GazeWearer wearer;
  wearer.wait_for_focus();
  tracking::GazeFollower follower;  // holds for 0.5 s
  const XrTime start = wearer.now();
  const auto source_at = [&](double time) {
    const XrTime display = start + nanoseconds(time);
    return std::string(xr::source_name(follower.step(xr::seconds(display), {}, wearer.read(display))));
  };
  for (int frame = 0; frame < 250; ++frame) {
    const double time = 0.01 * frame;
    const std::string source = source_at(time);
    const bool blink = time > 0.195 && time<0.415, lost = time> 1.005;
    // A tenth of a second without a sample is still the tracker's own stutter.
    if (time < 0.195 || (time > 0.425 && time < 0.995)) {
      EXPECT_EQ(source, "per-eye") << time;
    } else if (blink && time > 0.31) {
      EXPECT_EQ(source, "held") << time;
    } else if (lost && time > 1.7) {
      EXPECT_EQ(source, "head") << time;
    }
  }
}

TEST_F(GazeInput, EndsATraceAsItIsTold) {
  struct Case {
    const char* end;
    bool valid;
    glm::dvec3 direction;
  };
  // 0.7 s after the start of a trace of 0.4 s with rows 0.2 s apart, whose loop is 0.6 s long.
  for (const Case& c : {Case{"hold", true, yaw(-10)}, Case{"loop", true, yaw(10)}, Case{"stop", false, yaw(0)}}) {
    setenv("VERGENCE_GAZE_END", c.end, 1);
    const support::TraceFile trace(
        monado_, gaze_row(3.0, yaw(10), yaw(10)) + gaze_row(3.2, yaw(0), yaw(0)) + gaze_row(3.4, yaw(-10), yaw(-10)));
    GazeWearer wearer;
    wearer.wait_for_focus();
    const XrTime start = wearer.now();
    EXPECT_TRUE(wearer.read(start).valid);
    const auto sample = wearer.read(start + nanoseconds(0.7));
    ASSERT_EQ(sample.valid, c.valid) << c.end;
    if (c.valid) {
      EXPECT_LT(glm::length(*sample.eye[kRight] - c.direction), kFloatPose) << c.end;
    }
  }
}

// Whoever has an eye tracker: listens, and writes lines.
class Sender {
 public:
  explicit Sender(const std::filesystem::path& path) : listener_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    if (bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
        listen(listener_, 1) != 0) {
      throw std::runtime_error("cannot listen at " + path.string());
    }
  }
  ~Sender() {
    hang_up();
    close(listener_);
  }
  void accept() { connection_ = ::accept(listener_, nullptr, nullptr); }
  void hang_up() {
    if (connection_ >= 0) {
      close(connection_);
      connection_ = -1;
    }
  }
  void send(const std::string& text) const {
    ASSERT_EQ(::send(connection_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }

 private:
  int listener_, connection_ = -1;
};

bool comes_true(const std::function<bool()>& condition) {
  for (int tries = 0; tries < 1000; ++tries) {  // 5 s
    if (condition()) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST_F(GazeInput, FollowsASocket) {
  const auto path = monado_.folder() / "gaze.socket";
  setenv("VERGENCE_GAZE_SOCKET", path.c_str(), 1);
  Sender sender(path);
  testing::internal::CaptureStderr();
  {
    GazeWearer wearer;
    wearer.wait_for_focus();
    sender.accept();
    EXPECT_FALSE(wearer.read(wearer.now()).valid) << "nothing has been sent";

    std::timespec measured{};
    clock_gettime(CLOCK_MONOTONIC, &measured);
    const double stamp = static_cast<double>(measured.tv_sec) + static_cast<double>(measured.tv_nsec) * 1e-9;
    sender.send(std::string(support::kGazeHeader) + gaze_row(stamp, yaw(7), yaw(8)));
    ASSERT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; }));
    const auto sample = wearer.read(wearer.now() + nanoseconds(0.05));
    EXPECT_LT(glm::length(*sample.eye[kLeft] - yaw(7)), kFloatPose);
    EXPECT_LT(glm::length(*sample.eye[kRight] - yaw(8)), kFloatPose);
    // A stamp of some days in seconds is good to 0.1 us as a double.
    EXPECT_NEAR(sample.time.value(), xr::seconds(wearer.time_of(measured)), 1e-6);
    EXPECT_TRUE(comes_true([&] { return !wearer.read(wearer.now()).valid; })) << "silence is a loss";

    // Half a line is no line; the rest makes it one.
    const std::string row = gaze_row(0.0, yaw(1), yaw(1));
    sender.send(row.substr(0, 30));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(wearer.read(wearer.now()).valid);
    sender.send(row.substr(30));
    EXPECT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; })) << "0 is a stamp of the arrival";
    for (const char* bad : {"hello\n", "1,2,3\n", "-5,0,0,0,0,0,0,1,0,0,-1,0,0,-1,1\n",
                            "0,0,0,0,0,0,0,1,0,0,-1,0,0,inf,1\n", "0,0,0,0,0,0,0,1,0,0,-1,0,0,-1,2\n"}) {
      sender.send(gaze_row(0.0, yaw(1), yaw(1)));
      EXPECT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; }));
      sender.send(bad);
      EXPECT_TRUE(comes_true([&] { return !wearer.read(wearer.now()).valid; })) << bad;
    }
    // Further columns, where a header has named them.
    sender.send(
        "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,"
        "right_gy,right_gz,gaze_valid,device\n0,0,0,0,0,0,0,1,0,0,-1,0,0,-1,1,mine\n");
    EXPECT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; }));
    sender.send(std::string(support::kGazeHeader) + std::string(10000, '7'));
    sender.send("\n");
    sender.send(gaze_row(0.0, yaw(2), yaw(2)));
    EXPECT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; }));

    sender.hang_up();
    EXPECT_TRUE(comes_true([&] { return !wearer.read(wearer.now()).valid; }));
    sender.accept();
    sender.send(gaze_row(0.0, yaw(3), yaw(3)));
    EXPECT_TRUE(comes_true([&] { return wearer.read(wearer.now()).valid; })) << "a sender may come back";
  }
  const std::string said = testing::internal::GetCapturedStderr();
  const auto first = said.find("XR_APILAYER_VERGENCE_gaze: " + path.string() + ": line 2: has 1 fields");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("XR_APILAYER_VERGENCE_gaze: ", first + 1), std::string::npos) << "said once: " << said;
}

TEST_F(GazeInput, LivesWithoutASender) {
  const auto path = monado_.folder() / "nobody.socket";
  setenv("VERGENCE_GAZE_SOCKET", path.c_str(), 1);
  GazeWearer wearer;
  wearer.wait_for_focus();
  EXPECT_FALSE(wearer.read(wearer.now()).valid);
  EXPECT_TRUE(wearer.actions.support().per_eye);
}

// A gaze into the near zone of a progressive lens reads there what the lens gives along that direction.
TEST_F(GazeInput, ReachesTheLens) {
  const lenses::Lens lens = lenses::read_lens(VERGENCE_ASSETS "/lenses/progressive_add200_right.json");
  const lenses::Eye eye;
  // Through a point of the lens, as the eye turned about its centre sees it (the lens has no tilt).
  const auto through = [&](const glm::dvec2& point) {
    return glm::dvec3(point + lens.fit.decentration, -(lens.fit.vertex_distance + eye.centre_of_rotation_depth));
  };
  const glm::dvec3 far = through(*lens.reference_points.distance), near = through(*lens.reference_points.near);
  const support::TraceFile trace(monado_, gaze_row(0.0, far, far) + gaze_row(1.0, near, near));
  GazeWearer wearer;
  wearer.wait_for_focus();
  const auto power_along = [&](const glm::dvec3& gaze) {
    lenses::TraceRequest request;
    request.lens = lens;
    request.eye = eye;
    request.viewing = tracking::Viewing::gaze;
    request.gaze = request.direction = gaze;
    lenses::TraceBatch batch;
    lenses::append_request(batch, request);
    const auto result = lenses::to_result(lenses::trace_reference(batch).front(), batch.rays.front(), true);
    EXPECT_EQ(result.status, lenses::RayStatus::ok);
    return result.power;
  };
  const XrTime start = wearer.now();
  const double seen_far = power_along(*wearer.read(start).eye[kRight]);
  const double seen_near = power_along(*wearer.read(start + nanoseconds(1.0)).eye[kRight]);
  // The pose's rounding moves the ray by 50 nm on the lens; power changes there by less than 1 D a millimetre.
  EXPECT_NEAR(seen_far, power_along(far), 1e-4);
  EXPECT_NEAR(seen_near, power_along(near), 1e-4);
  // It is the near zone of a lens with an addition of 2 D: read at the pupil and obliquely, the better part of that.
  EXPECT_GT(seen_near - seen_far, 1.5);
}

}  // namespace
