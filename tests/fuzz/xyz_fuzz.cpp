#include "tests/fuzz/sag_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz_sag(lenses::SagFormat::xyz, data, size);
}
