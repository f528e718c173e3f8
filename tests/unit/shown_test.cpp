// What the wearer's controls make of the view.
#include "app/vr/shown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using app::Shown;
using app::ShownChoices;
using app::ShownPicture;
using render::Mode;
using xr::Control;

using Pairs = std::vector<std::size_t>;

ShownChoices choices(std::size_t in_turn, bool has_compared = false, std::size_t targets = 0) {
  return {.in_turn = in_turn,
          .has_compared = has_compared,
          .targets = targets,
          .picture = Mode::adof,
          .first_map = Mode::adof};
}

Pairs pairs_after(Shown shown, std::initializer_list<Control> controls) {
  for (const Control control : controls) {
    shown.apply(control);
  }
  return shown.picture().pairs;
}

TEST(Shown, SpectaclesComeOffAndOn) {
  const Shown one(choices(1));
  EXPECT_EQ(pairs_after(one, {}), Pairs{0});
  EXPECT_EQ(pairs_after(one, {Control::spectacles}), Pairs{1}) << "the eyes without";
  EXPECT_EQ(pairs_after(one, {Control::spectacles, Control::spectacles}), Pairs{0});
}

TEST(Shown, PairsComeInTurnAndPutThemselvesOn) {
  const Shown three(choices(3));
  EXPECT_EQ(pairs_after(three, {Control::next_pair}), Pairs{1});
  EXPECT_EQ(pairs_after(three, {Control::next_pair, Control::next_pair, Control::next_pair}), Pairs{0});
  EXPECT_EQ(pairs_after(three, {Control::spectacles, Control::next_pair}), Pairs{1});
  EXPECT_EQ(pairs_after(Shown(choices(1)), {Control::spectacles, Control::next_pair}), Pairs{0});
}

TEST(Shown, AIsAgainstTheComparedPairElseTheNextElseNone) {
  const Shown compared(choices(2, true));
  EXPECT_EQ(pairs_after(compared, {}), (Pairs{0, 2})) << "asked for on the command line";
  EXPECT_EQ(pairs_after(compared, {Control::next_pair}), (Pairs{1, 2}));
  EXPECT_EQ(pairs_after(compared, {Control::compare}), Pairs{0});
  EXPECT_EQ(pairs_after(compared, {Control::spectacles}), Pairs{3});
  const Shown two(choices(2));
  EXPECT_EQ(pairs_after(two, {}), Pairs{0});
  EXPECT_EQ(pairs_after(two, {Control::compare}), (Pairs{0, 1}));
  EXPECT_EQ(pairs_after(two, {Control::compare, Control::next_pair}), (Pairs{1, 0}));
  EXPECT_EQ(pairs_after(two, {Control::compare, Control::compare}), Pairs{0});
  EXPECT_EQ(pairs_after(two, {Control::spectacles, Control::compare}), (Pairs{0, 1})) << "puts them on";
  EXPECT_EQ(pairs_after(Shown(choices(1)), {Control::compare}), (Pairs{0, 1})) << "against none";
}

TEST(Shown, MapsComeInTurnThenThePicture) {
  Shown shown(choices(1));
  std::vector<Mode> seen;
  for (int i = 0; i < 6; ++i) {
    seen.push_back(shown.picture().mode);
    shown.apply(Control::map);
  }
  EXPECT_EQ(seen,
            (std::vector{Mode::adof, Mode::power, Mode::astigmatism, Mode::accommodation, Mode::blur, Mode::adof}));
  ShownChoices map_first = choices(1);
  map_first.first_map = Mode::blur;
  Shown from_map(map_first);
  EXPECT_EQ(from_map.picture().mode, Mode::blur);
  from_map.apply(Control::map);
  EXPECT_EQ(from_map.picture().mode, Mode::adof);
}

TEST(Shown, OneKeyClearsTheViewAndBringsItBack) {
  Shown shown(choices(2, true, 3));
  for (const Control control : {Control::next_pair, Control::map}) {
    shown.apply(control);
  }
  const ShownPicture before = shown.picture();
  EXPECT_TRUE(shown.apply(Control::clear_view));
  const ShownPicture clear{{3}, Mode::pinhole};  // no lens, no blur, no map
  EXPECT_TRUE(shown.is_clear());
  EXPECT_EQ(shown.picture(), clear);
  for (const Control touched : {Control::spectacles, Control::next_pair, Control::compare, Control::map}) {
    EXPECT_FALSE(shown.apply(touched));
    EXPECT_EQ(shown.picture(), clear) << xr::name(touched);
  }
  EXPECT_TRUE(shown.apply(Control::next_target));
  EXPECT_TRUE(shown.apply(Control::clear_view));
  EXPECT_EQ(shown.picture(), before);
}

TEST(Shown, TargetsComeInTurnThenTheHeadsDirection) {
  Shown shown(choices(1, false, 2));
  EXPECT_FALSE(shown.target());
  EXPECT_TRUE(shown.apply(Control::next_target));
  EXPECT_EQ(shown.target(), 0U);
  shown.apply(Control::next_target);
  EXPECT_EQ(shown.target(), 1U);
  shown.apply(Control::next_target);
  EXPECT_FALSE(shown.target());
  Shown none(choices(1));
  EXPECT_FALSE(none.apply(Control::next_target)) << "a scene without targets";
  EXPECT_FALSE(none.target());
}

// Whatever is pressed, one press of clear_view shows the clear view, and every picture is one that was prepared for.
TEST(Shown, EveryPictureIsAmongThoseThatCanBeReached) {
  std::mt19937_64 random(6);  // the seed
  for (const ShownChoices& some : {choices(1), choices(1, true), choices(3), choices(4, true, 2)}) {
    Shown shown(some);
    const std::vector<ShownPicture> reachable = shown.reachable();
    for (int i = 0; i < 500; ++i) {
      shown.apply(xr::kControls[random() % xr::kControls.size()]);
      EXPECT_TRUE(std::ranges::find(reachable, shown.picture()) != reachable.end());
      for (const std::size_t pair : shown.picture().pairs) {
        EXPECT_LT(pair, some.pairs());
      }
      Shown pressed = shown;
      pressed.apply(Control::clear_view);
      EXPECT_EQ((shown.is_clear() ? shown : pressed).picture(), (ShownPicture{{some.bare()}, Mode::pinhole}));
    }
  }
}

}  // namespace
