#include "lenses/lens_io/oma_trace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "lenses/lens_io/json_document.hpp"

namespace lenses::io {
namespace {

constexpr std::size_t kFewestPoints = 8, kMostPoints = 4000;
constexpr double kLeastRadius = 100.0, kGreatestRadius = 10000.0;  // 0.01 mm
constexpr std::size_t kWrittenPoints = 360, kPerLine = 10;

// A trace while its records come in.
struct OpenTrace {
  OmaTrace trace;
  std::size_t count;
  bool equal_angles;
  std::vector<double> radii, angles;  // 0.01 mm, 0.01 degrees
};

OpenTrace open_trace(const OmaJob& job, std::size_t line) {
  const auto fields = split(job.lines[line].value(), ';');
  if (fields.size() < 4) job.fail(line, "has too few fields; must be 1;points;E|U;R|L;F");
  if (trimmed(fields[0]) != "1") {
    job.fail(line, "is of format " + in_quotes(fields[0]) + "; only format 1, radii as text, is read");
  }
  const auto count = number_in(fields[1]);
  if (!count || *count != std::floor(*count) || *count < double{kFewestPoints} || *count > double{kMostPoints}) {
    job.fail(line, "has " + in_quotes(fields[1]) + " points; " + std::to_string(kFewestPoints) + " to " +
                       std::to_string(kMostPoints) + " are allowed");
  }
  const std::string_view spacing = trimmed(fields[2]), side = trimmed(fields[3]);
  if (spacing != "E" && spacing != "U") job.fail(line, "is of spacing " + in_quotes(spacing) + "; must be E or U");
  if (side != "R" && side != "L") job.fail(line, "is of side " + in_quotes(side) + "; must be R or L");
  return {{side == "R" ? Side::right : Side::left, line, line + 1, {}},
          static_cast<std::size_t>(*count),
          spacing == "E",
          {},
          {}};
}

void take_numbers(const OmaJob& job, std::size_t line, double low, double high, std::size_t most,
                  std::vector<double>& into) {
  for (const std::string_view word : split(job.lines[line].value(), ';')) {
    const auto value = number_in(word);
    if (!value || *value < low || *value > high) {
      job.fail(line, "holds " + in_quotes(word) + "; numbers from " + std::to_string(static_cast<int>(low)) + " to " +
                         std::to_string(static_cast<int>(high)) + " are allowed");
    }
    if (into.size() == most) job.fail(line, "holds more numbers than the trace has points, " + std::to_string(most));
    into.push_back(*value);
  }
}

OmaTrace close_trace(const OmaJob& job, OpenTrace& open) {
  const std::size_t line = open.trace.first_line;
  const auto need = [&](const char* label, std::size_t found) {
    if (found == open.count) return;
    job.fail(line, "announces " + std::to_string(open.count) + " points; its " + label + " records hold " +
                       std::to_string(found));
  };
  need("R", open.radii.size());
  if (!open.equal_angles) need("A", open.angles.size());
  for (std::size_t i = 0; i < open.count; ++i) {
    const double turn =
        open.equal_angles ? static_cast<double>(i) / static_cast<double>(open.count) : open.angles[i] / 36000.0;
    if (!open.equal_angles && i > 0 && open.angles[i] <= open.angles[i - 1]) {
      job.fail(line, "has angles that do not increase; each must exceed the one before it");
    }
    const double angle = 2.0 * std::numbers::pi * turn;
    const double radius = open.radii[i] * 1e-5;
    open.trace.outline.emplace_back(-radius * std::cos(angle), radius * std::sin(angle));
  }
  // The viewer's counter-clockwise is the wearer's clockwise.
  std::reverse(open.trace.outline.begin(), open.trace.outline.end());
  return std::move(open.trace);
}

// Where the ray from the origin meets the outline.
double radius_at(const std::vector<glm::dvec2>& outline, const glm::dvec2& direction) {
  std::optional<double> found;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double at_a = direction.x * a.y - direction.y * a.x, at_b = direction.x * b.y - direction.y * b.x;
    if ((at_a < 0.0) == (at_b < 0.0)) continue;
    const double share = at_a / (at_a - at_b);
    const double radius = direction.x * (a.x + share * (b.x - a.x)) + direction.y * (a.y + share * (b.y - a.y));
    if (radius <= 0.0) continue;
    if (found) throw std::invalid_argument("the outline cannot be traced: a ray from its box's centre leaves it twice");
    found = radius;
  }
  if (!found) throw std::invalid_argument("the outline cannot be traced: its box's centre is outside of it");
  return *found;
}

}  // namespace

std::vector<OmaTrace> read_traces(const OmaJob& job) {
  std::vector<OmaTrace> traces;
  std::optional<OpenTrace> open;
  for (std::size_t i = 0; i < job.lines.size(); ++i) {
    const std::string_view label = job.lines[i].label();
    if (label == "TRCFMT") {
      if (open) traces.push_back(close_trace(job, *open));
      open = open_trace(job, i);
    } else if (label == "R" || label == "A") {
      if (!open) job.fail(i, "stands before any TRCFMT record, which must announce it");
      if (label == "R") {
        take_numbers(job, i, kLeastRadius, kGreatestRadius, open->count, open->radii);
      } else {
        take_numbers(job, i, 0.0, 36000.0, open->count, open->angles);
      }
      open->trace.end_line = i + 1;
    }
  }
  if (open) traces.push_back(close_trace(job, *open));
  return traces;
}

std::vector<glm::dvec2> mirrored(const std::vector<glm::dvec2>& outline) {
  std::vector<glm::dvec2> result;
  for (auto point = outline.rbegin(); point != outline.rend(); ++point) result.emplace_back(-point->x, point->y);
  return result;
}

std::vector<std::string> trace_lines(const std::vector<glm::dvec2>& outline, Side side) {
  std::vector<std::string> lines{"TRCFMT=1;"};
  lines.back().append(std::to_string(kWrittenPoints)).append(side == Side::right ? ";E;R;F" : ";E;L;F");
  for (std::size_t i = 0; i < kWrittenPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kWrittenPoints);
    const auto radius = std::lround(1e5 * radius_at(outline, {-std::cos(angle), std::sin(angle)}));
    if (i % kPerLine == 0) {
      lines.emplace_back("R=");
    } else {
      lines.back() += ';';
    }
    lines.back() += std::to_string(radius);
  }
  return lines;
}

}  // namespace lenses::io
