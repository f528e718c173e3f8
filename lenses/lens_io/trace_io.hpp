// The `trace` command's JSON Lines: one request a line in, one result or error a line out.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lenses/lens.hpp"
#include "lenses/trace_result.hpp"

namespace lenses {

struct TraceRequest {
  using Viewing = tracking::Viewing;

  std::string id_json = "null";  // the id as JSON text, to be written back as it is
  std::optional<Lens> lens;      // absent: bare eye
  Eye eye;
  Side side = Side::right;
  Viewing viewing = Viewing::fixed;
  // Both in primary-gaze eye axes, of any length; the reader brings the largest component into [1, 2) by a power of
  // two, which is exact, so that squares neither overflow nor vanish.
  glm::dvec3 gaze{0.0, 0.0, -1.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
  std::optional<double> object_distance;  // m; absent: infinity
};

// Lens files named by requests, each read once. Relative paths start at the base folder.
class LensCache {
 public:
  explicit LensCache(std::string base_folder) : base_folder_(std::move(base_folder)) {}

  // The reference stays valid as long as the cache. Throws tracking::InputError of the lens file; a failure is not
  // remembered.
  [[nodiscard]] const Lens& read(const std::string& path);

 private:
  std::string base_folder_;
  std::map<std::string, Lens, std::less<>> lenses_;
};

// `file` and `line_number` (from 1) are what errors carry: the field reads `line 3: lens.front.radius_mm`.
[[nodiscard]] TraceRequest parse_trace_line(std::string_view line, const std::string& file, std::size_t line_number,
                                            LensCache& lens_files);
// The same without a cache, for a single line.
[[nodiscard]] TraceRequest parse_trace_line(std::string_view line, const std::string& file, std::size_t line_number,
                                            const std::string& base_folder);

// The id of a line as JSON text, "null" when the line has none or is not JSON: for the answer to a bad line.
[[nodiscard]] std::string trace_line_id(std::string_view line);

// One line each, without the line's end. Numbers are the shortest text that reads back as the same double; what is not
// finite is null.
[[nodiscard]] std::string format_trace_result(const std::string& id_json, const TraceResult& result);
[[nodiscard]] std::string format_trace_error(const std::string& id_json, const std::string& message);

}  // namespace lenses
