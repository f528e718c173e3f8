#include "app/vr/mirror_feed.hpp"

#include <algorithm>

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Clock::duration kPeriod = std::chrono::nanoseconds(1'000'000'000 / 30);
// Fetching 3.7 MB takes the host a part of a millisecond; a larger window enlarges them.
constexpr std::array kLargest{1280, 720};

}  // namespace

void MirrorFeed::after_frame(const render::ShownPictures& shown) {
  if (copy_.take(picture_)) {
    link_.put(picture_);
  }
  const auto now = Clock::now();
  if (copy_.is_under_way() || now < next_) {
    return;
  }
  const std::array<int, 2> room = link_.room();
  const auto size =
      render::MirrorCopy::size_in(shown, {std::min(room[0], kLargest[0]), std::min(room[1], kLargest[1])});
  if (size[0] > 0) {
    copy_.start(shown, size);
    next_ = now + kPeriod;
  }
}

}  // namespace app
