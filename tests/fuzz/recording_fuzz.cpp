// Any bytes make the record of a session or are refused by InputError, and what is read can be written and read again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "app/recording/session_record.hpp"
#include "tracking/input_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::optional<app::SessionRecord> record;
  try {
    record = app::parse_session_record(text, "fuzz.json");
  } catch (const tracking::InputError&) {
    return 0;
  }
  const std::string written = app::to_json(*record);
  if (app::to_json(app::parse_session_record(written, "written.json")) != written) std::abort();
  return 0;
}
