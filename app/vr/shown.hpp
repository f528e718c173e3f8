// What is worn and shown in the headset, as the wearer's controls change it. Pure: it knows neither lenses nor
// pictures.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "render/renderer.hpp"
#include "xr/controls.hpp"

namespace app {

// What a session has to choose from. Pairs are counted through: those that are put on in turn, the one that is only
// compared with, and at last the eyes without spectacles.
struct ShownChoices {
  std::size_t in_turn = 1;    // at least 1
  bool has_compared = false;  // a pair for A against B alone
  std::size_t targets = 0;    // of the scene
  render::Mode picture{};     // where no map lies over it
  render::Mode first_map{};   // shown at the start; `picture`: none

  [[nodiscard]] std::size_t compared() const { return in_turn; }
  [[nodiscard]] std::size_t bare() const { return in_turn + (has_compared ? 1 : 0); }
  [[nodiscard]] std::size_t pairs() const { return bare() + 1; }
};

// The pairs in view, one or A and B, and what is drawn of the world through them.
struct ShownPicture {
  std::vector<std::size_t> pairs;
  render::Mode mode{};
  bool operator==(const ShownPicture&) const = default;
};

class Shown {
 public:
  // Begins with the first pair, against the compared one if there is one.
  explicit Shown(const ShownChoices& choices);

  // recentre changes nothing here. While the view is clear only clear_view and next_target are heeded: a button touched
  // by mistake must not bring back what somebody wanted gone, and what was there comes back as it was. False where
  // nothing came of it.
  bool apply(xr::Control control);

  [[nodiscard]] ShownPicture picture() const;
  // What is drawn where no map lies over it and the view is not clear.
  [[nodiscard]] render::Mode base() const { return choices_.picture; }
  [[nodiscard]] bool is_clear() const { return clear_; }
  [[nodiscard]] const std::optional<std::size_t>& target() const { return target_; }

  // Every picture that controls can lead to from here.
  [[nodiscard]] std::vector<ShownPicture> reachable() const;

 private:
  [[nodiscard]] std::vector<std::size_t> against(std::size_t pair) const;

  ShownChoices choices_;
  std::size_t pair_ = 0;
  bool spectacles_ = true, comparing_ = false, clear_ = false;
  render::Mode mode_{};
  std::optional<std::size_t> target_;
};

}  // namespace app
