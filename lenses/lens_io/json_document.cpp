#include "lenses/lens_io/json_document.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <vector>

#include "tracking/input_error.hpp"

namespace lenses::io {
namespace {

using nlohmann::json;
using tracking::InputError;

// Follows the parser from event to event: knows the path of what is being read, and stops at a repeated key or at the
// depth limit before the value is built.
class StructureGuard {
 public:
  explicit StructureGuard(const Source& source) : source_(source) {}

  void see(json::parse_event_t event, const json& parsed) {
    using Event = json::parse_event_t;
    if (event == Event::key) {
      enter_key(parsed.get_ref<const std::string&>());
      return;
    }
    if (event == Event::object_end || event == Event::array_end) {
      levels_.pop_back();
      return;
    }
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().next_index;
    if (event == Event::object_start || event == Event::array_start) enter_container(event == Event::array_start);
  }

  // The path of the value that follows the last event.
  [[nodiscard]] std::string next_path() const { return path(true); }

 private:
  struct Level {
    bool is_array;
    std::set<std::string, std::less<>> keys;
    std::string key;
    std::size_t next_index = 0;
  };

  void enter_key(const std::string& key) {
    levels_.back().key = key;
    if (!levels_.back().keys.insert(key).second) {
      throw InputError(source_.file, field_name(source_, path(false)), "is given twice; a key may appear once");
    }
  }

  void enter_container(bool is_array) {
    if (levels_.size() >= kMaxDepth) {
      throw InputError(source_.file, source_.place,
                       "is nested too deeply; at most " + std::to_string(kMaxDepth) + " levels are allowed");
    }
    levels_.push_back({is_array, {}, {}, 0});
  }

  [[nodiscard]] std::string path(bool of_next) const {
    std::string result;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const Level& level = levels_[i];
      if (!level.is_array) {
        result = join_path(result, level.key);
        continue;
      }
      const bool innermost = i + 1 == levels_.size();
      result = join_path(result, innermost && of_next ? level.next_index : level.next_index - 1);
    }
    return result;
  }

  const Source& source_;
  std::vector<Level> levels_;
};

std::string cut(std::string text, std::size_t length) {
  if (text.size() <= length) return text;
  text.resize(length);
  return text + "...";
}

// The library's message without its own prefix, which repeats the position.
std::string syntax_detail(const std::string& what) {
  const std::size_t column = what.find("column ");
  const std::size_t colon = column == std::string::npos ? column : what.find(": ", column);
  return cut(colon == std::string::npos ? what : what.substr(colon + 2), 160);
}

[[noreturn]] void fail_syntax(std::string_view text, const Source& source, const json::parse_error& error) {
  // error.byte counts the bytes read, the offending one included.
  const std::size_t offending = std::min(error.byte == 0 ? 0 : error.byte - 1, text.size());
  const std::string_view before = text.substr(0, offending);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  std::string position = "column " + std::to_string(offending - line_start + 1);
  if (source.place.empty()) position = "line " + std::to_string(line) + ", " + position;
  throw InputError(source.file, source.place, position + ": not valid JSON: " + syntax_detail(error.what()));
}

}  // namespace

std::string read_text_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path, "", "cannot be read: it is a folder; a file is needed");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    const std::string cause = errno != 0 ? std::generic_category().message(errno) : "it cannot be opened";
    throw InputError(path, "", "cannot be read: " + cause);
  }
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 16);
  while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || stream.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxFileBytes) {
      throw InputError(path, "", "is too large; files of up to 64 MiB are read");
    }
  }
  if (stream.bad()) throw InputError(path, "", "cannot be read: the medium reports an error");
  return text;
}

json parse_json(std::string_view text, const Source& source) {
  if (text.size() > kMaxFileBytes) {
    throw InputError(source.file, source.place, "is too large; up to 64 MiB are read");
  }
  StructureGuard guard(source);
  const auto watch = [&guard](int, json::parse_event_t event, json& parsed) {
    guard.see(event, parsed);
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), watch);
  } catch (const json::parse_error& error) {
    fail_syntax(text, source, error);
  } catch (const json::out_of_range&) {
    throw InputError(source.file, field_name(source, guard.next_path()),
                     "is not a finite number in double precision; numbers of up to 1.79e308 are allowed");
  }
}

std::string join_path(const std::string& path, std::string_view key) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '$' || c == '-'; };
  const bool one_word = !key.empty() && key.size() <= 64 && std::all_of(key.begin(), key.end(), plain);
  const std::string part = one_word ? std::string(key) : in_quotes(key);
  return path.empty() ? part : path + "." + part;
}

std::string join_path(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

std::string field_name(const Source& source, const std::string& path) {
  if (source.place.empty()) return path;
  return path.empty() ? source.place : source.place + ": " + path;
}

std::string in_quotes(std::string_view text) {
  const std::string shortened = cut(std::string(text), 64);
  return json(shortened).dump(-1, ' ', true, json::error_handler_t::replace);
}

}  // namespace lenses::io
