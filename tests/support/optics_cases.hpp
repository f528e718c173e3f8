// The traced cases of tests/data: one JSON object a line with the trace command's input, the expected output and the
// tolerance a float engine is held to.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "lenses/lens_io/trace_io.hpp"

namespace support {

struct OpticsCase {
  std::string id;
  bool borderline = false;
  nlohmann::json expected;
  double gpu_tolerance = 0.0;  // D; 0 where the status alone is expected
  lenses::TraceRequest request;
};

inline std::vector<OpticsCase> read_optics_cases() {
  std::vector<OpticsCase> cases;
  for (const char* name : {"optics-cases.jsonl", "viewing-cases.jsonl"}) {
    const std::string path = std::string(VERGENCE_TEST_DATA) + "/" + name;
    std::ifstream file(path);
    if (!file) {
      throw std::runtime_error(path + " cannot be read");
    }
    std::string line;
    while (std::getline(file, line)) {
      const nlohmann::json j = nlohmann::json::parse(line);
      OpticsCase c;
      c.id = j.at("id");
      c.borderline = j.value("borderline", false);
      c.expected = j.at("expected");
      c.gpu_tolerance = j.at("tolerance_gpu_D").is_null() ? 0.0 : j.at("tolerance_gpu_D").get<double>();
      c.request = lenses::parse_trace_line(j.at("input").dump(), path, cases.size() + 1, std::string());
      cases.push_back(c);
    }
  }
  return cases;
}

}  // namespace support
