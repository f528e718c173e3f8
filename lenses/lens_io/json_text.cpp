#include "lenses/lens_io/json_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace lenses::io {
namespace {

using nlohmann::ordered_json;

void append_value(std::string& out, const ordered_json& value, std::size_t indent);

void append_object(std::string& out, const ordered_json& object, std::size_t indent) {
  if (object.empty()) {
    out += "{}";
    return;
  }
  const char* separator = "{\n";
  for (const auto& [key, member] : object.items()) {
    out.append(separator).append(indent + 2, ' ').append(string_text(key)).append(": ");
    append_value(out, member, indent + 2);
    separator = ",\n";
  }
  out.append("\n").append(indent, ' ').append("}");
}

void append_array(std::string& out, const ordered_json& array, std::size_t indent) {
  // Rows of a control net get a line each; everything flat stays on one.
  const bool rows = array.size() > 3 && array.front().is_array();
  out += "[";
  bool first = true;
  for (const ordered_json& element : array) {
    if (!first) out += rows ? "," : ", ";
    if (rows) out.append("\n").append(indent + 2, ' ');
    append_value(out, element, indent + 2);
    first = false;
  }
  if (rows) out.append("\n").append(indent, ' ');
  out += "]";
}

void append_value(std::string& out, const ordered_json& value, std::size_t indent) {
  if (value.is_object()) {
    append_object(out, value, indent);
  } else if (value.is_array()) {
    append_array(out, value, indent);
  } else if (value.is_number_float()) {
    out += number_text(value.get<double>());
  } else {
    out += value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }
}

}  // namespace

std::string number_text(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {std::begin(text), end};
}

std::string string_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

double rounded(double value, int digits) {
  char text[32];
  const auto end =
      std::to_chars(std::begin(text), std::end(text), value, std::chars_format::scientific, digits - 1).ptr;
  double result = value;
  std::from_chars(std::begin(text), end, result);
  return result;
}

std::string document_text(const ordered_json& value) {
  std::string out;
  append_value(out, value, 0);
  return out + "\n";
}

}  // namespace lenses::io
