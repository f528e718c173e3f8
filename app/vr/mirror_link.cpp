#include "app/vr/mirror_link.hpp"

#include <utility>

namespace app {
namespace {

constexpr std::size_t kMostPressed =
    32;  // while nobody listens: a hand that plays on the keys is not remembered for ever

}  // namespace

void MirrorLink::expect(int width, int height) {
  const std::lock_guard lock(mutex_);
  const std::array shape{width, height};
  is_new_shape_ = is_new_shape_ || shape != shape_;
  shape_ = shape;
}

std::array<int, 2> MirrorLink::room() const {
  const std::lock_guard lock(mutex_);
  return room_;
}

void MirrorLink::put(render::MirrorPicture& picture) {
  const std::lock_guard lock(mutex_);
  std::swap(picture_, picture);
  is_new_picture_ = true;
}

std::vector<xr::Control> MirrorLink::pressed() {
  const std::lock_guard lock(mutex_);
  return std::exchange(pressed_, {});
}

std::optional<std::array<int, 2>> MirrorLink::take_shape() {
  const std::lock_guard lock(mutex_);
  return std::exchange(is_new_shape_, false) ? std::optional(shape_) : std::nullopt;
}

void MirrorLink::set_room(const std::array<int, 2>& room) {
  const std::lock_guard lock(mutex_);
  room_ = room;
}

bool MirrorLink::take(render::MirrorPicture& picture) {
  const std::lock_guard lock(mutex_);
  if (!is_new_picture_) {
    return false;
  }
  std::swap(picture_, picture);
  is_new_picture_ = false;
  return true;
}

void MirrorLink::press(xr::Control control) {
  const std::lock_guard lock(mutex_);
  if (pressed_.size() < kMostPressed) {
    pressed_.push_back(control);
  }
}

}  // namespace app
