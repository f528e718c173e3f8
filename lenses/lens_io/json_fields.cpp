#include "lenses/lens_io/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/units.hpp"
#include "tracking/input_error.hpp"

namespace lenses::io {
namespace {

constexpr int kVersion = 1;

bool is_annotation(std::string_view key) {
  return key.starts_with('_') || key == "comment" || key == "note";
}

std::string describe_value(const nlohmann::json& value) {
  if (value.is_number()) return number_text(value.get<double>());
  if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  return "null";
}

}  // namespace

bool Limits::allow(double value) const {
  return std::isfinite(value) && value <= high && (above_low ? value > low : value >= low);
}

double Limits::to_si(double value) const {
  switch (unit) {
    case Unit::plain:
      return value;
    case Unit::millimetres:
      return from_mm(value);
    case Unit::micrometres:
      return from_um(value);
    case Unit::degrees:
      return from_degrees(value);
  }
  return value;
}

std::string Limits::describe() const {
  const std::string from = above_low ? "a number above " : "a number from ";
  return from + number_text(low) + (above_low ? " and up to " : " to ") + number_text(high);
}

void Field::fail(const std::string& reason) const {
  throw tracking::InputError(source_->file, field_name(*source_, path_), reason);
}

void Field::fail_type(const std::string& expected) const {
  fail("is " + describe_value(*value_) + "; must be " + expected);
}

void Field::fail_below(const std::string& path, const std::string& reason) const {
  throw tracking::InputError(source_->file, field_name(*source_, path_.empty() ? path : path_ + "." + path), reason);
}

void Field::require_object() const {
  if (!value_->is_object()) fail_type("an object");
}

void Field::refuse_unknown(Keys keys, Keys more, Keys unnamed) const {
  require_object();
  for (const auto& [key, unused] : value_->items()) {
    const auto is_key = [&key = key](Keys list) { return std::find(list.begin(), list.end(), key) != list.end(); };
    if (is_key(keys) || is_key(more) || is_key(unnamed) || is_annotation(key)) continue;
    std::string allowed;
    for (const Keys& list : {keys, more}) {
      for (const std::string_view name : list) allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    Field(*value_, *source_, join_path(path_, key)).fail("is an unknown key; allowed: " + allowed);
  }
}

void Field::allow_only(Keys keys, Keys more) const {
  refuse_unknown(keys, more, {});
}

void Field::allow_only_in_root(Keys keys) const {
  require_object();
  check_version();
  refuse_unknown(keys, {}, {"$schema", "name", "version"});
}

// Before unknown keys: what a newer version added is better explained by its number.
void Field::check_version() const {
  const std::optional<Field> version = find("version");
  if (!version) return;
  const nlohmann::json& value = version->value();
  if (value.is_number() && value.get<double>() == kVersion) return;
  if (value.is_number() && value.get<double>() > kVersion) {
    version->fail("is " + describe_value(value) + ", newer than this program reads; version 1 is allowed");
  }
  version->fail_type("the number 1");
}

std::optional<Field> Field::find(std::string_view key) const {
  require_object();
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Field(*found, *source_, join_path(path_, key));
}

Field Field::require(std::string_view key, const std::string& expected) const {
  const std::optional<Field> found = find(key);
  if (!found) Field(*value_, *source_, join_path(path_, key)).fail("is missing; must be " + expected);
  return *found;
}

double Field::required_number(std::string_view key, const Limits& limits) const {
  return require(key, limits.describe()).number(limits);
}

void Field::read(std::string_view key, const Limits& limits, double& target) const {
  if (const auto found = find(key)) target = found->number(limits);
}

void Field::read(std::string_view key, const Limits& limits, std::optional<double>& target) const {
  if (const auto found = find(key)) target = found->number(limits);
}

bool Field::is_null() const {
  return value_->is_null();
}

double Field::number(const Limits& limits) const {
  if (!value_->is_number() || !limits.allow(value_->get<double>())) fail_type(limits.describe());
  return limits.to_si(value_->get<double>());
}

double Field::axis() const {
  if (!value_->is_number()) fail_type("a number of degrees");
  const double turned = std::fmod(value_->get<double>(), 180.0);
  const double folded = turned < 0.0 ? turned + 180.0 : turned;
  return folded < 180.0 ? from_degrees(folded) : 0.0;  // -1e-20 + 180 rounds to 180
}

bool Field::truth() const {
  if (!value_->is_boolean()) fail_type("true or false");
  return value_->get<bool>();
}

const std::string& Field::text(const std::string& expected) const {
  if (!value_->is_string()) fail_type(expected);
  return value_->get_ref<const std::string&>();
}

Field Field::element(std::size_t index) const {
  return {value_->at(index), *source_, join_path(path_, index)};
}

void Field::require_array(std::size_t fewest, std::size_t most, const std::string& of_what) const {
  if (value_->is_array() && value_->size() >= fewest && value_->size() <= most) return;
  const std::string count =
      fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " to " + std::to_string(most);
  fail_type("an array of " + count + " " + of_what);
}

std::vector<Field> Field::elements(std::size_t fewest, std::size_t most, const std::string& of_what) const {
  require_array(fewest, most, of_what);
  std::vector<Field> result;
  result.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) result.push_back(element(i));
  return result;
}

// Control nets hold thousands of numbers: an element's path is spelled out only when it is needed.
std::vector<double> Field::numbers(const Limits& limits, std::size_t fewest, std::size_t most) const {
  require_array(fewest, most, "numbers");
  std::vector<double> result;
  result.reserve(value_->size());
  for (const nlohmann::json& entry : *value_) {
    const bool good = entry.is_number() && limits.allow(entry.get<double>());
    result.push_back(good ? limits.to_si(entry.get<double>()) : element(result.size()).number(limits));
  }
  return result;
}

glm::dvec2 Field::pair(const Limits& limits) const {
  const std::vector<double> values = numbers(limits, 2, 2);
  return {values[0], values[1]};
}

glm::dvec3 Field::triple(const Limits& limits) const {
  const std::vector<double> values = numbers(limits, 3, 3);
  return {values[0], values[1], values[2]};
}

}  // namespace lenses::io
