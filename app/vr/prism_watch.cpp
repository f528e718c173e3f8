#include "app/vr/prism_watch.hpp"

#include <algorithm>

namespace app {
namespace {

constexpr double kHold = 1.5;  // s; eyes that read come back to a place of a lens sooner

}  // namespace

std::vector<ViewerFinding> PrismWatch::see(double time, const std::vector<ViewerFinding>& found) {
  std::vector<ViewerFinding> fresh;
  for (const ViewerFinding& finding : found) {
    const auto known = std::ranges::find(current_, finding.pair, &ViewerFinding::pair);
    if (known != current_.end()) {
      last_[static_cast<std::size_t>(known - current_.begin())] = time;
    } else {
      current_.push_back(finding);
      last_.push_back(time);
      fresh.push_back(finding);
    }
  }
  for (std::size_t i = current_.size(); i-- > 0;) {
    if (time - last_[i] > kHold) {
      current_.erase(current_.begin() + static_cast<std::ptrdiff_t>(i));
      last_.erase(last_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return fresh;
}

void PrismWatch::forget() {
  current_.clear();
  last_.clear();
}

}  // namespace app
