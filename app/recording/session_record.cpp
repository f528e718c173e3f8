#include "app/recording/session_record.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_fields.hpp"
#include "lenses/lens_io/json_text.hpp"

namespace app {
namespace {

using lenses::io::Field;
using lenses::io::plain;
using nlohmann::ordered_json;
using tracking::Side;

constexpr std::size_t kMostChanges = 1'000'000;
constexpr double kMostFrames = 4e6;
constexpr double kMostPixels = 16384.0;
constexpr double kMostPairs = 63.0;     // of spectacles, in one session
constexpr double kMostOffset = 10.0;    // m, of a view from the head
constexpr double kMostTangent = 100.0;  // of half a field of view
constexpr double kUnitExactly = 1e-6;   // off unit length, as in a trace
constexpr std::array<std::pair<const char*, Side>, 2> kSides{{{"left", Side::left}, {"right", Side::right}}};

ordered_json view_object(const RecordedView& view) {
  const glm::dvec3& p = view.head_from_view.position;
  const glm::dquat& q = view.head_from_view.orientation;
  const tracking::FieldOfView& f = view.fov;
  return {{"position_m", {p.x, p.y, p.z}},
          {"orientation_xyzw", {q.x, q.y, q.z, q.w}},
          {"fov_tan", {f.tan_left, f.tan_right, f.tan_down, f.tan_up}}};
}

ordered_json names_array(const std::vector<NameChange>& changes) {
  ordered_json array = ordered_json::array();
  for (const NameChange& change : changes) array.push_back({{"frame", change.frame}, {"name", change.name}});
  return array;
}

std::size_t whole(const Field& field, double most) {
  const double value = field.number(plain(0.0, most));
  if (value != std::floor(value)) {
    field.fail("is " + lenses::io::number_text(value) + "; a whole number is needed");
  }
  return static_cast<std::size_t>(value);
}

// The frames of a list do not decrease.
template <class Change>
std::size_t read_frame(const Field& object, const std::vector<Change>& before) {
  const Field frame = object.require("frame", "a frame's number, from 0");
  const std::size_t value = whole(frame, kMostFrames);
  if (!before.empty() && value < before.back().frame) {
    frame.fail("is " + std::to_string(value) + ", before the entry above it; frames must not decrease");
  }
  return value;
}

RecordedView read_view(const Field& object) {
  object.allow_only({"position_m", "orientation_xyzw", "fov_tan"});
  RecordedView view;
  view.head_from_view.position =
      object.require("position_m", "an array of 3 numbers").triple(plain(-kMostOffset, kMostOffset));
  const Field orientation = object.require("orientation_xyzw", "an array of 4 numbers");
  const std::vector<double> q = orientation.numbers(plain(-1.01, 1.01), 4, 4);
  const glm::dquat turn(q[3], q[0], q[1], q[2]);
  const double off = std::abs(glm::length(turn) - 1.0);
  if (off > 1e-3) {
    orientation.fail("is no unit quaternion; its length must be 1 to within 0.001");
  }
  view.head_from_view.orientation = off > kUnitExactly ? glm::normalize(turn) : turn;
  const Field fov = object.require("fov_tan", "an array of 4 numbers: left, right, down, up");
  const std::vector<double> t = fov.numbers(plain(-kMostTangent, kMostTangent), 4, 4);
  view.fov = {t[0], t[1], t[2], t[3]};
  if (!(t[0] + t[1] > 0.0) || !(t[2] + t[3] > 0.0)) {
    fov.fail("is an empty field of view; left + right and down + up must be positive");
  }
  return view;
}

std::vector<Field> entries(const Field& object, std::string_view key) {
  const auto list = object.find(key);
  return list ? list->elements(0, kMostChanges, "changes") : std::vector<Field>{};
}

std::string read_name(const Field& object, const char* key) {
  const Field name = object.require(key, "a string");
  if (name.text().empty()) {
    name.fail("is empty; a name is needed");
  }
  return name.text();
}

std::vector<NameChange> read_names(const Field& object, std::string_view key) {
  std::vector<NameChange> changes;
  for (const Field& entry : entries(object, key)) {
    entry.allow_only({"frame", "name"});
    changes.push_back({read_frame(entry, changes), read_name(entry, "name")});
  }
  return changes;
}

std::vector<ShownChange> read_shown(const Field& object) {
  std::vector<ShownChange> changes;
  for (const Field& entry : entries(object, "shown")) {
    entry.allow_only({"frame", "pairs", "picture"});
    ShownChange change{read_frame(entry, changes), {}, read_name(entry, "picture")};
    for (const Field& pair : entry.require("pairs", "an array of 1 or 2 whole numbers").elements(1, 2, "pairs")) {
      change.pairs.push_back(static_cast<std::size_t>(whole(pair, kMostPairs)));
    }
    changes.push_back(std::move(change));
  }
  return changes;
}

void read_options(const Field& object, SessionRecord& record) {
  if (!object.value().is_object()) {
    object.fail_type("an object of strings");
  }
  for (const auto& [key, unused] : object.value().items()) {
    record.options.emplace_back(key, object.require(key, "a string").text());
  }
}

}  // namespace

std::string record_file(const std::string& trace_file) {
  return trace_file + ".json";
}

std::string to_json(const SessionRecord& record) {
  ordered_json document = {{"version", 1}, {"device", record.device}, {"size_px", {record.size[0], record.size[1]}}};
  document["options"] = ordered_json::object();
  for (const auto& [name, value] : record.options) document["options"][name] = value;
  document["views"] = ordered_json::array();
  for (const ViewChange& change : record.views) {
    ordered_json entry = {{"frame", change.frame}};
    for (const auto& [name, side] : kSides) entry[name] = view_object(change.view[static_cast<std::size_t>(side)]);
    document["views"].push_back(std::move(entry));
  }
  document["rungs"] = names_array(record.rungs);
  document["pairs"] = names_array(record.pairs);
  document["shown"] = ordered_json::array();
  for (const ShownChange& change : record.shown) {
    document["shown"].push_back({{"frame", change.frame}, {"pairs", change.pairs}, {"picture", change.picture}});
  }
  document["events"] = ordered_json::array();
  for (const RecordedEvent& event : record.events) {
    document["events"].push_back({{"frame", event.frame}, {"time_s", event.time}, {"event", event.what}});
  }
  return lenses::io::document_text(document);
}

SessionRecord parse_session_record(std::string_view text, const std::string& file) {
  const lenses::io::Source source{file, ""};
  const nlohmann::json document = lenses::io::parse_json(text, source);
  const Field object(document, source);
  object.allow_only_in_root({"device", "size_px", "options", "views", "rungs", "pairs", "events", "shown"});
  SessionRecord record;
  if (const auto device = object.find("device")) record.device = device->text();
  if (const auto size = object.find("size_px")) {
    const auto sides = size->elements(2, 2, "whole numbers");
    record.size = {static_cast<int>(whole(sides[0], kMostPixels)), static_cast<int>(whole(sides[1], kMostPixels))};
  }
  if (const auto options = object.find("options")) read_options(*options, record);
  for (const Field& entry : entries(object, "views")) {
    entry.allow_only({"frame", "left", "right"});
    ViewChange change{read_frame(entry, record.views), {}};
    for (const auto& [name, side] : kSides) {
      change.view[static_cast<std::size_t>(side)] = read_view(entry.require(name, "a view"));
    }
    record.views.push_back(change);
  }
  record.rungs = read_names(object, "rungs");
  record.pairs = read_names(object, "pairs");
  for (const Field& entry : entries(object, "events")) {
    entry.allow_only({"frame", "time_s", "event"});
    record.events.push_back({read_frame(entry, record.events), entry.required_number("time_s", plain(-1e12, 1e12)),
                             read_name(entry, "event")});
  }
  record.shown = read_shown(object);
  return record;
}

}  // namespace app
