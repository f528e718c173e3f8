#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/eye_reader.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/lens_reader.hpp"
#include "lenses/lens_io/trace_io.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

using io::Field;
using nlohmann::json;

bool is_id(const json& value) {
  return value.is_null() || value.is_string() || value.is_number();
}

std::string id_text(const json& id) {
  if (id.is_number_float()) return io::number_text(id.get<double>());
  return id.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string read_id(const Field& line) {
  const auto id = line.find("id");
  if (!id) return "null";
  if (!is_id(id->value())) id->fail_type("a string, a number or null");
  return id_text(id->value());
}

glm::dvec3 read_direction(const Field& field) {
  const double most = std::numeric_limits<double>::max();
  const glm::dvec3 direction = field.triple(io::plain(-most, most));
  const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (largest == 0.0) field.fail("has no length; must be [x, y, z] of any length but 0");
  const int exponent = -std::ilogb(largest);
  return {std::scalbn(direction.x, exponent), std::scalbn(direction.y, exponent), std::scalbn(direction.z, exponent)};
}

const Lens& read_lens_file(const Field& field, LensCache& lens_files) {
  const std::string& path = field.text("the path of a lens file, or null");
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (path.empty() || std::any_of(path.begin(), path.end(), is_control)) {
    field.fail_type("a path that is not empty and has no control characters");
  }
  try {
    return lens_files.read(path);
  } catch (const tracking::InputError& error) {
    field.fail(error.what());
  }
}

std::optional<Lens> read_lens_of(const Field& line, Side side, LensCache& lens_files) {
  const auto lens = line.find("lens");
  const auto lens_file = line.find("lens_file");
  const bool has_lens = lens && !lens->is_null();
  const bool has_file = lens_file && !lens_file->is_null();
  if (has_lens && has_file) lens_file->fail("is given beside lens; only one of the two is allowed");
  if (has_lens) return io::read_lens_object(*lens, side);
  if (has_file) return read_lens_file(*lens_file, lens_files);
  return std::nullopt;
}

void read_viewing(const Field& line, TraceRequest& request) {
  using Viewing = TraceRequest::Viewing;
  if (const auto viewing = line.find("viewing")) {
    request.viewing =
        viewing->choice<Viewing>({{"fixed", Viewing::fixed}, {"scanning", Viewing::scanning}, {"gaze", Viewing::gaze}});
  }
  if (request.viewing == Viewing::gaze) {
    request.gaze = read_direction(line.require("gaze", "[x, y, z], as viewing is \"gaze\""));
  } else if (const auto gaze = line.find("gaze")) {
    request.gaze = read_direction(*gaze);
  }
}

}  // namespace

const Lens& LensCache::read(const std::string& path) {
  const std::string resolved = (std::filesystem::path(base_folder_) / path).string();
  const auto found = lenses_.find(resolved);
  if (found != lenses_.end()) return found->second;
  return lenses_.emplace(resolved, read_lens(resolved)).first->second;
}

TraceRequest parse_trace_line(std::string_view line, const std::string& file, std::size_t line_number,
                              LensCache& lens_files) {
  const io::Source source{file, "line " + std::to_string(line_number)};
  const json document = io::parse_json(line, source);
  const Field object(document, source);
  object.allow_only_in_root(
      {"id", "lens", "lens_file", "eye", "side", "viewing", "gaze", "direction", "object_distance_m"});
  TraceRequest request;
  request.id_json = read_id(object);
  if (const auto side = object.find("side")) {
    request.side = side->choice<Side>({{"right", Side::right}, {"left", Side::left}});
  }
  request.lens = read_lens_of(object, request.side, lens_files);
  if (const auto eye = object.find("eye")) request.eye = io::read_eye_object(*eye);
  read_viewing(object, request);
  request.direction = read_direction(object.require("direction", "[x, y, z], from the pupil outward"));
  if (const auto distance = object.find("object_distance_m"); distance && !distance->is_null()) {
    request.object_distance = distance->number(io::plain(1e-6, std::numeric_limits<double>::max()));
  }
  return request;
}

TraceRequest parse_trace_line(std::string_view line, const std::string& file, std::size_t line_number,
                              const std::string& base_folder) {
  LensCache lens_files(base_folder);
  return parse_trace_line(line, file, line_number, lens_files);
}

std::string trace_line_id(std::string_view line) {
  if (line.size() > io::kMaxFileBytes) return "null";
  // Only the line's own members are kept, whatever lies inside them.
  const auto keep = [](int depth, json::parse_event_t, const json&) { return depth <= 1; };
  const json document = json::parse(line.begin(), line.end(), keep, false);
  if (!document.is_object()) return "null";
  const auto id = document.find("id");
  return id != document.end() && is_id(*id) ? id_text(*id) : "null";
}

}  // namespace lenses
