// Any bytes are read or refused by InputError, and what is read can be written and read again.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/trace_io.hpp"
#include "tracking/input_error.hpp"

namespace {

template <class Parse>
void read_write_read(Parse parse, std::string_view text) {
  const auto read = [&]() -> std::optional<decltype(parse(text, std::string()))> {
    try {
      return parse(text, "/nonexistent/fuzz.json");  // whose folder holds no file that a surface could name
    } catch (const tracking::InputError&) {
      return std::nullopt;
    }
  }();
  if (read) (void)parse(lenses::to_json(*read), "written.json");
}

void read_line(std::string_view line) {
  // A request may name any file of this machine, a device among them.
  if (line.find("lens_file") != std::string_view::npos) return;
  try {
    (void)lenses::parse_trace_line(line, "/nonexistent/fuzz.jsonl", 1, "/nonexistent");
  } catch (const tracking::InputError& error) {
    (void)lenses::format_trace_error(lenses::trace_line_id(line), error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read_write_read(lenses::parse_lens, text);
  read_write_read(lenses::parse_spectacles, text);
  read_write_read(lenses::parse_wearer, text);
  read_write_read(lenses::parse_headset, text);
  read_line(text);
  return 0;
}
