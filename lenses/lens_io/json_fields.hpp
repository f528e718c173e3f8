// Typed, range-checked access to a JSON value that knows its own path, so that every error names its field.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lenses/lens_io/json_document.hpp"

namespace lenses::io {

// What a number may be, in the file's unit, and which unit that is.
struct Limits {
  enum class Unit { plain, millimetres, micrometres, degrees };
  double low, high;
  Unit unit = Unit::plain;
  bool above_low = false;  // low itself is not allowed

  [[nodiscard]] bool allow(double value) const;
  [[nodiscard]] double to_si(double value) const;
  [[nodiscard]] std::string describe() const;  // "a number from 1 to 4"
};

[[nodiscard]] constexpr Limits plain(double low, double high) {
  return {low, high, Limits::Unit::plain};
}
[[nodiscard]] constexpr Limits millimetres(double low, double high) {
  return {low, high, Limits::Unit::millimetres};
}
[[nodiscard]] constexpr Limits micrometres(double low, double high) {
  return {low, high, Limits::Unit::micrometres};
}
[[nodiscard]] constexpr Limits degrees(double low, double high) {
  return {low, high, Limits::Unit::degrees};
}

// Refers to the document and its source; both must outlive it.
class Field {
 public:
  Field(const nlohmann::json& value, const Source& source, std::string path = {})
      : value_(&value), source_(&source), path_(std::move(path)) {}

  [[nodiscard]] const nlohmann::json& value() const { return *value_; }
  [[nodiscard]] const std::string& file() const { return source_->file; }
  [[noreturn]] void fail(const std::string& reason) const;
  // The reason is what is wrong with the value at hand, which is named, and what it must be.
  [[noreturn]] void fail_type(const std::string& expected) const;
  // The same for a member, by its path from here (`fit.wrap_deg`), whether it is there or follows by rule.
  [[noreturn]] void fail_below(const std::string& path, const std::string& reason) const;

  // Objects. Members whose name starts with "_" and members called comment or note are for people and pass everywhere.
  using Keys = std::initializer_list<std::string_view>;
  void allow_only(Keys keys, Keys more = {}) const;
  // The same for what may be a file of its own: $schema, name and version pass too, and version is checked.
  void allow_only_in_root(Keys keys) const;
  [[nodiscard]] std::optional<Field> find(std::string_view key) const;
  [[nodiscard]] Field require(std::string_view key, const std::string& expected) const;

  // Members that are numbers, in SI units. read leaves the target as it is when the member is absent.
  [[nodiscard]] double required_number(std::string_view key, const Limits& limits) const;
  void read(std::string_view key, const Limits& limits, double& target) const;
  void read(std::string_view key, const Limits& limits, std::optional<double>& target) const;

  // The value itself.
  [[nodiscard]] bool is_null() const;
  [[nodiscard]] double number(const Limits& limits) const;
  [[nodiscard]] double axis() const;  // degrees, any, folded into [0, 180); radians out
  [[nodiscard]] bool truth() const;
  [[nodiscard]] const std::string& text(const std::string& expected = "a string") const;
  [[nodiscard]] std::vector<Field> elements(std::size_t fewest, std::size_t most, const std::string& of_what) const;
  [[nodiscard]] std::vector<double> numbers(const Limits& limits, std::size_t fewest, std::size_t most) const;
  [[nodiscard]] glm::dvec2 pair(const Limits& limits) const;
  [[nodiscard]] glm::dvec3 triple(const Limits& limits) const;

  template <class Enum>
  [[nodiscard]] Enum choice(std::initializer_list<std::pair<std::string_view, Enum>> choices) const {
    std::string expected = "one of";
    for (const auto& [name, unused] : choices) expected += " \"" + std::string(name) + "\"";
    const std::string& chosen = text(expected);
    for (const auto& [name, result] : choices) {
      if (name == chosen) return result;
    }
    fail_type(expected);
  }

 private:
  void require_object() const;
  // A message names keys and more as what is allowed, not the unnamed ones.
  void refuse_unknown(Keys keys, Keys more, Keys unnamed) const;
  void check_version() const;
  void require_array(std::size_t fewest, std::size_t most, const std::string& of_what) const;
  [[nodiscard]] Field element(std::size_t index) const;

  const nlohmann::json* value_;
  const Source* source_;
  std::string path_;
};

}  // namespace lenses::io
