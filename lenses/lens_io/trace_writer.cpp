#include <initializer_list>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/trace_io.hpp"

namespace lenses {
namespace {

using io::number_text;

// One line's object, member by member, in the order of the calls.
class LineObject {
 public:
  explicit LineObject(const std::string& id_json) { text_.append("{\"id\": ").append(id_json); }

  void add(const char* key, const std::string& json) { text_.append(", \"").append(key).append("\": ").append(json); }
  void add(const char* key, double value) { add(key, number_text(value)); }
  void add(const char* key, const std::optional<double>& value) { add(key, value ? number_text(*value) : "null"); }
  void add(const char* key, std::initializer_list<double> values) {
    std::string list;
    for (const double value : values) list.append(list.empty() ? "[" : ", ").append(number_text(value));
    add(key, list.append("]"));
  }
  void add(const char* key, const glm::dvec2& v) { add(key, {v.x, v.y}); }
  void add(const char* key, const glm::dvec3& v) { add(key, {v.x, v.y, v.z}); }
  void add_null(const char* key) { add(key, std::string("null")); }

  [[nodiscard]] std::string finish() const { return text_ + "}"; }

 private:
  std::string text_;
};

void add_measured(LineObject& line, const TraceResult& result) {
  line.add("vergence_D", result.vergence);
  line.add("power_D", result.power);
  line.add("astigmatism_D", result.astigmatism);
  line.add("axis_deg", result.axis_deg);
  if (result.has_lens) {
    line.add("back_hit_m", result.back_hit);
    line.add("front_hit_m", result.front_hit);
  } else {
    line.add_null("back_hit_m");
    line.add_null("front_hit_m");
  }
  line.add("object_direction", result.object_direction);
  line.add("deviation_rad", result.deviation);
  line.add("accommodation_D", result.accommodation);
  line.add("residual_D", result.residual);
  line.add("blur_rad", result.blur);
  line.add("blur_axis_deg", result.blur_axis_deg);
}

void add_nothing_measured(LineObject& line) {
  for (const char* key :
       {"vergence_D", "power_D", "astigmatism_D", "axis_deg", "back_hit_m", "front_hit_m", "object_direction",
        "deviation_rad", "accommodation_D", "residual_D", "blur_rad", "blur_axis_deg"}) {
    line.add_null(key);
  }
}

}  // namespace

std::string format_trace_result(const std::string& id_json, const TraceResult& result) {
  LineObject line(id_json);
  line.add("status", io::string_text(name(result.status)));
  if (result.status == RayStatus::ok) {
    add_measured(line, result);
  } else {
    add_nothing_measured(line);
  }
  return line.finish();
}

std::string format_trace_error(const std::string& id_json, const std::string& message) {
  LineObject line(id_json);
  line.add("error", io::string_text(message));
  return line.finish();
}

}  // namespace lenses
