#include "lenses/lens_io/oma_job.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "tracking/input_error.hpp"

namespace lenses::io {
namespace {

constexpr std::size_t kLongestLabel = 32;
constexpr std::size_t kMostLines = 100000;  // two traces and four surfaces of the largest size need a tenth

bool is_label(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !text.empty() && text.size() <= kLongestLabel && std::ranges::all_of(text, allowed);
}

bool is_unknown(std::string_view value) {
  return value.empty() || value == "?";
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string_view OmaLine::label() const {
  const std::size_t equals = text.find('=');
  return equals == std::string::npos ? std::string_view() : trimmed(std::string_view(text).substr(0, equals));
}

std::string_view OmaLine::value() const {
  const std::size_t equals = text.find('=');
  return equals == std::string::npos ? std::string_view() : trimmed(std::string_view(text).substr(equals + 1));
}

std::string OmaJob::text() const {
  std::string result;
  for (const OmaLine& line : lines) result.append(line.text).append(line.ending);
  return result;
}

std::string OmaJob::place(std::size_t line) const {
  const std::string number = "line " + std::to_string(line + 1);
  const std::string_view label = lines[line].label();
  return label.empty() ? number : number + ": " + std::string(label);
}

void OmaJob::fail(std::size_t line, const std::string& reason) const {
  throw tracking::InputError(file, place(line), reason);
}

std::optional<std::size_t> OmaJob::find(std::string_view label) const {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].label() != label) continue;
    if (found) fail(i, "is given twice; this record may appear once");
    found = i;
  }
  return found;
}

std::optional<std::string_view> OmaJob::value_of(std::string_view label, Side side) const {
  const auto line = find(label);
  if (!line) return std::nullopt;
  const auto parts = split(lines[*line].value(), ';');
  if (parts.size() > 2) fail(*line, "has " + std::to_string(parts.size()) + " fields; right;left or one is allowed");
  const std::string_view part = trimmed(parts.size() == 2 && side == Side::left ? parts[1] : parts[0]);
  return is_unknown(part) ? std::nullopt : std::optional(part);
}

std::optional<double> OmaJob::number_of(std::string_view label, Side side, double low, double high) const {
  const auto part = value_of(label, side);
  if (!part) return std::nullopt;
  const auto value = number_in(*part);
  if (!value || *value < low || *value > high) {
    fail(*find(label), "is " + in_quotes(*part) + "; must be a number from " + number_text(low) + " to " +
                           number_text(high) + ", or ? when it is not known");
  }
  return value;
}

void OmaJob::set(std::string_view label, std::string_view value) {
  const std::string text = std::string(label) + "=" + std::string(value);
  if (const auto line = find(label)) {
    if (lines[*line].value() != value) lines[*line].text = text;
    return;
  }
  const auto is_block = [](const OmaLine& line) { return line.label() == "TRCFMT" || line.label() == "SURFMT"; };
  const auto at = std::ranges::find_if(lines, is_block);
  const std::string ending = lines.empty() || lines.front().ending.empty() ? "\r\n" : lines.front().ending;
  if (at == lines.end() && !lines.empty() && lines.back().ending.empty()) lines.back().ending = ending;
  lines.insert(at, {text, ending});
}

OmaJob parse_oma(std::string_view text, const std::string& file) {
  if (text.size() > kMaxFileBytes) throw tracking::InputError(file, "", "is too large; up to 64 MiB are read");
  OmaJob job{file, {}};
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    std::size_t ending = 0;
    if (end != std::string_view::npos) ending = text.substr(end, 2) == "\r\n" ? 2 : 1;
    const std::string_view line = text.substr(0, end);
    if (job.lines.size() == kMostLines) {
      throw tracking::InputError(file, "", "has too many lines; up to " + std::to_string(kMostLines) + " are read");
    }
    job.lines.push_back({std::string(line), ending == 0 ? "" : std::string(text.substr(end, ending))});
    text.remove_prefix(line.size() + ending);
    if (!trimmed(line).empty() && !is_label(job.lines.back().label())) {
      throw tracking::InputError(file, "line " + std::to_string(job.lines.size()),
                                 "is " + in_quotes(line) + "; must be LABEL=value, the label of letters, digits and _");
    }
  }
  return job;
}

OmaJob read_oma(const std::string& path) {
  return parse_oma(read_text_file(path), path);
}

}  // namespace lenses::io
