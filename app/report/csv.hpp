// Tables as CSV (RFC 4180, lines ended by a line feed).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace app {

class Csv {
 public:
  explicit Csv(std::string_view header) : text_(header) { text_ += '\n'; }

  Csv& add(std::string_view cell);
  // Six decimals; an empty cell for none or for what is not finite.
  Csv& add(std::optional<double> number);
  Csv& empty(int cells);
  void end_row();

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void separate();

  std::string text_;
  bool first_ = true;
};

}  // namespace app
