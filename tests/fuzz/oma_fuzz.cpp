// Any bytes make a job or are refused by InputError; a job comes back byte for byte; its order can be read, and where
// it makes spectacles without a design of their own, they can be written.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "tracking/input_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const lenses::io::OmaJob job = lenses::io::parse_oma(text, "fuzz.oma");
    if (job.text() != text) std::abort();
    (void)lenses::read_order(job);
    // Designs of lenses take seconds under the sanitizers; radii and tables do not.
    if (job.find("SPH") || text.find("FRNT") == std::string_view::npos) return 0;
    const lenses::Spectacles pair = lenses::spectacles_of(job, {.fit = {.most_controls = 12}}).spectacles;
    (void)to_json(pair);
    (void)job_of(pair, "fuzz.json", {.base = job, .grid = 5});
  } catch (const tracking::InputError&) {
  }
  return 0;
}
