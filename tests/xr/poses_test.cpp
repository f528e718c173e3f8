// Poses and fields of view that a headset reports arrive unchanged, and the picture is where they say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "render/live_frame.hpp"
#include "tests/support/headset_program.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/remote_head.hpp"

namespace {

using support::HeadsetProgram;
using support::RemoteHead;
using tracking::Pose;
using tracking::Side;

constexpr std::array kSides{Side::right, Side::left};

std::size_t view_of(Side side) {
  return side == Side::left ? 0 : 1;
}

class Headset : public testing::Test {
 protected:
  Headset() { support::leave_network(); }
};

RemoteHead::Pose remote(const Pose& pose) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {{f(pose.orientation.x), f(pose.orientation.y), f(pose.orientation.z), f(pose.orientation.w)},
          {f(pose.position.x), f(pose.position.y), f(pose.position.z)}};
}

Pose random_pose(std::mt19937& random, double turn, const glm::dvec3& centre, double reach) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const glm::dvec3 axis = glm::normalize(glm::dvec3(any(random), any(random), any(random)) + 1e-3);
  return {glm::angleAxis(turn * any(random), axis), centre + reach * glm::dvec3(any(random), any(random), any(random))};
}

// Any head, eyes some 6 cm apart, each turned by itself by up to 10 deg (canted displays), each field of view lopsided.
RemoteHead random_head(std::mt19937& random) {
  std::uniform_real_distribution<float> angle(0.3F, 0.9F);
  RemoteHead head;
  head.head = remote(random_pose(random, 1.5, {0.0, 1.6, 0.0}, 0.8));
  for (const Side side : kSides) {
    RemoteHead::View& view = head.view[view_of(side)];
    view.head_from_view = remote(random_pose(random, 0.17, {side == Side::right ? 0.032 : -0.032, 0.0, 0.0}, 0.004));
    view.fov = {-angle(random), angle(random), angle(random), -angle(random)};
  }
  return head;
}

Pose pose_of(const RemoteHead::Pose& pose) {
  return {glm::normalize(glm::dquat(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z)),
          {pose.position.x, pose.position.y, pose.position.z}};
}

double difference(const Pose& a, const Pose& b) {
  const double sign = glm::dot(a.orientation, b.orientation) < 0.0 ? -1.0 : 1.0;
  const glm::dquat turn = a.orientation - sign * b.orientation;
  return std::max(glm::length(turn), glm::length(a.position - b.position));
}

double difference(const tracking::FieldOfView& a, const RemoteHead::Fov& b) {
  return std::max({std::abs(a.tan_left + std::tan(b.left)), std::abs(a.tan_right - std::tan(b.right)),
                   std::abs(a.tan_up - std::tan(b.up)), std::abs(a.tan_down + std::tan(b.down))});
}

TEST_F(Headset, PosesAndFieldsOfViewComeBackAsTheyWereSent) {
  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  HeadsetProgram program({.space = xr::SpaceChoice::stage, .size = std::array{64, 64}});
  std::mt19937 random(20120904);
  hub.tell(random_head(random));
  auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  for (int i = 0; i < 200; ++i) {
    program.loop.skip(*frame);
    const RemoteHead head = random_head(random);
    hub.tell(head);
    frame = program.loop.next();
    ASSERT_TRUE(frame && frame->should_render) << i;
    // Float poses of lengths about 2 m, multiplied with one another by the runtime: 1e-6 is ten of their last places.
    const Pose space_from_head = pose_of(head.head);
    EXPECT_LT(difference(frame->space_from_head, space_from_head), 1e-6) << i;
    for (const Side side : kSides) {
      const RemoteHead::View& sent = head.view[view_of(side)];
      const xr::HeadsetView& view = frame->views[static_cast<std::size_t>(side)];
      EXPECT_LT(difference(view.head_from_view, pose_of(sent.head_from_view)), 1e-6) << i;
      EXPECT_LT(difference(view.space_from_view, space_from_head * pose_of(sent.head_from_view)), 1e-6) << i;
      EXPECT_LT(difference(view.fov, sent.fov), 1e-6) << i;
    }
  }
  program.loop.skip(*frame);
  program.leave();
}

// The user recentres: LOCAL's origin moves to where the head is, from an announced time on. (Monado does not say how
// far.)
TEST_F(Headset, RecentringMovesTheSpaceAtItsTime) {
  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  RemoteHead head;
  const Pose in_room{glm::angleAxis(0.6, glm::dvec3(0.0, 1.0, 0.0)), {0.5, 1.4, -0.3}};
  head.head = remote(in_room);
  hub.tell(head);
  HeadsetProgram program({.space = xr::SpaceChoice::local, .size = std::array{64, 64}});
  auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  const Pose before = frame->space_from_head;
  ASSERT_EQ(std::system(VERGENCE_MONADO "/bin/monado-ctl -c >/dev/null 2>&1"), 0);
  std::optional<Pose> new_from_old;
  for (int i = 0; i < 200 && !new_from_old; ++i) {
    program.loop.skip(*frame);
    frame = program.loop.next();
    ASSERT_TRUE(frame);
    new_from_old = frame->new_from_old;
    if (!new_from_old) {
      EXPECT_LT(difference(frame->space_from_head, before), 1e-5) << "moved before it was announced to";
    }
  }
  ASSERT_TRUE(new_from_old);
  // LOCAL looks where the head does, level, from where it is.
  const glm::dvec3 ahead = frame->space_from_head.direction({0.0, 0.0, -1.0});
  EXPECT_LT(glm::length(ahead - glm::dvec3(0.0, 0.0, -1.0)), 1e-5);
  EXPECT_LT(std::abs(frame->space_from_head.position.x) + std::abs(frame->space_from_head.position.z), 1e-5);
  program.loop.skip(*frame);
  program.leave();
}

// Where the brightness of a picture has its middle, pixels from the upper left corner.
glm::dvec2 middle_of_light(const render::Image8& image) {
  glm::dvec2 sum(0.0);
  double total = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double light = image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
      sum += light * glm::dvec2(x + 0.5, y + 0.5);
      total += light;
    }
  }
  return total > 0.0 ? sum / total : glm::dvec2(-1.0);
}

// By hand: the point in the view's axes, its tangents between those of the field's edges.
glm::dvec2 pixel_of(const glm::dvec3& point, const Pose& space_from_view, const RemoteHead::Fov& fov, int side) {
  const glm::dvec3 p = space_from_view.inverse().point(point);
  const double left = std::tan(fov.left), right = std::tan(fov.right), up = std::tan(fov.up), down = std::tan(fov.down);
  return {side * (p.x / -p.z - left) / (right - left), side * (up - p.y / -p.z) / (up - down)};
}

// A small light in the dark is drawn where each eye's own pose and field of view put it.
TEST_F(Headset, ThePictureIsWhereThePoseSays) {
  constexpr int kSide = 96;
  const glm::dvec3 light(0.3, 1.5, -4.0);
  render::Scene scene = support::dark_scene();
  support::add_ball(scene, support::add_material(scene, support::unlit({1, 1, 1, 1})), glm::vec3(light), 0.12F, 12);
  const support::Monado monado({.remote = true});
  support::RemoteHub hub;
  HeadsetProgram program({.space = xr::SpaceChoice::stage, .size = std::array{kSide, kSide}, .readable = true});
  render::Renderer renderer(program.device, scene, {.traversal = render::Traversal::per_ray});
  lenses::LensModel model;
  std::vector<render::ViewSetup> views(2);  // left, right
  for (render::ViewSetup& view : views) {
    view.lens = lenses::append_lens(model, nullptr, Side::right, 0.00305);
    view.eye = lenses::make_eye_data(lenses::Eye{}, 5.0, 0.003);
    view.viewing = render::Viewing::fixed;
    view.view.fov = tracking::FieldOfView::symmetric(1.0, 1.0);
  }
  render::LiveConfig config;
  config.frame.width = config.frame.height = kSide;
  config.frame.mode = render::Mode::pinhole;
  render::LiveFrame live(renderer, model, views, config,
                         {program.loop.swapchain(Side::left).images(), program.loop.swapchain(Side::right).images()});
  std::mt19937 random(7);
  int seen = 0;
  for (int i = 0; i < 24; ++i) {
    RemoteHead head = random_head(random);
    head.head = remote(random_pose(random, 0.4, {0.0, 1.6, 0.0}, 0.3));
    hub.tell(head);
    const auto frame = program.next_visible();
    ASSERT_TRUE(frame);
    for (const Side side : kSides) {
      render::ViewSetup& view = views[view_of(side)];
      const xr::HeadsetView& located = frame->views[static_cast<std::size_t>(side)];
      view.world_from_eye = {frame->space_from_head.orientation, located.space_from_view.position};
      view.view.head_from_view = located.head_from_view;
      view.view.fov = located.fov;
    }
    const auto images = program.loop.acquire();
    const std::array order{images[1], images[0]};  // by Side: right first; the live frame's eyes: left first
    live.start(model, views, order);
    std::array<render::Image8, 2> pictures;
    for (const std::size_t eye : {0U, 1U}) {
      pictures[eye] = live.read_image(eye, order[eye]);
    }
    program.loop.show(*frame);
    for (const std::size_t eye : {0U, 1U}) {
      const glm::dvec2 wanted =
          pixel_of(light, pose_of(head.head) * pose_of(head.view[eye].head_from_view), head.view[eye].fov, kSide);
      if (wanted.x < 8.0 || wanted.y < 8.0 || wanted.x > kSide - 8.0 || wanted.y > kSide - 8.0) {
        continue;  // the ball, up to 6 pixels wide, would not be whole
      }
      ++seen;
      // A ball's outline is drawn larger on its far side, by a fraction of a pixel at the edge of a wide view; one
      // pixel more than that would be 1.5 cm at the light.
      EXPECT_LT(glm::length(middle_of_light(pictures[eye]) - wanted), 0.5) << i << " eye " << eye;
    }
  }
  EXPECT_GT(seen, 20);
  program.leave();
}

}  // namespace
