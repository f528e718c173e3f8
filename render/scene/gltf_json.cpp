#include "render/scene/gltf_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tracking/input_error.hpp"

namespace render {
namespace {

using nlohmann::json;

// Far beyond any real file; tinygltf descends into extras by recursion.
constexpr int kDeepest = 64;
// Names count as well. A value takes up to a hundred bytes as a tree, of which tinygltf makes a second; a node of a
// scene is some ten values.
constexpr std::size_t kMostValues = std::size_t{1} << 22;
constexpr std::size_t kMostText = std::size_t{1}
                                  << 28;  // bytes; a buffer inside the text is held five times in passing

// Walks over the text without keeping any of it; stops at the first thing that is wrong. A parser that asks back for
// each value would do too, but that of this library takes a time that grows as the square of an array's length.
class Bounds : public nlohmann::json_sax<json> {
 public:
  [[nodiscard]] bool too_deep() const { return too_deep_; }
  [[nodiscard]] bool too_many() const { return values_ > kMostValues; }

  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool key(string_t&) override { return count(); }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool count() { return ++values_ <= kMostValues; }
  bool open() {
    too_deep_ = ++depth_ > kDeepest;
    return !too_deep_ && count();
  }
  bool close() {
    --depth_;
    return true;
  }

  std::size_t values_ = 0;
  int depth_ = 0;
  bool too_deep_ = false;
};

}  // namespace

std::string one_line(std::string text) {
  if (text.size() > 300) text = text.substr(0, 300) + "...";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

json parse_gltf_json(const std::string& file, std::string_view text) {
  if (text.size() > kMostText) {
    throw tracking::InputError(file, "",
                               "has " + std::to_string(text.size()) + " bytes of JSON; " + std::to_string(kMostText) +
                                   " are allowed, and buffers of their own may have more");
  }
  Bounds bounds;
  (void)json::sax_parse(text, &bounds);
  if (bounds.too_deep()) throw tracking::InputError(file, "", "nests deeper than 64 levels; 64 are allowed");
  if (bounds.too_many()) {
    throw tracking::InputError(file, "",
                               "holds more than " + std::to_string(kMostValues) + " values and names; " +
                                   std::to_string(kMostValues) + " are allowed");
  }
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    // Without the library's own name for it, which stands in brackets.
    const std::string what = error.what();
    const std::size_t name = what.find("] ");
    const std::string said = what.substr(name == std::string::npos ? 0 : name + 2);
    throw tracking::InputError(file, "", "is not valid JSON: " + one_line(said) + "; a .gltf or .glb file is expected");
  }
}

}  // namespace render
