// Vertical prism where the eyes look now, as a warning that does not flicker: it stands from when the limit is first
// exceeded until it has not been for a while, with the words that it began with.
#pragma once

#include <vector>

#include "app/viewer_report.hpp"

namespace app {

class PrismWatch {
 public:
  // What is found in the frame at `time` (s); returns what is new.
  std::vector<ViewerFinding> see(double time, const std::vector<ViewerFinding>& found);

  // Other spectacles.
  void forget();

  [[nodiscard]] const std::vector<ViewerFinding>& current() const { return current_; }

 private:
  std::vector<ViewerFinding> current_;
  std::vector<double> last_;  // s, when each was last found
};

}  // namespace app
