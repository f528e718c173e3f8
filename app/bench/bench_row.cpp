#include "app/bench/bench_row.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace app {
namespace {

const PeerRow* peer_of(const BenchRow& row, std::span<const PeerRow> peers) {
  const auto found =
      std::ranges::find_if(peers, [&](const PeerRow& peer) { return peer.lens == row.lens && peer.size == row.size; });
  return found == peers.end() ? nullptr : &*found;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    out += c == '"' ? "\"\"" : std::string(1, c);
  }
  return out + "\"";
}

// A file's name may hold anything.
std::string field(const std::string& text) {
  return text.find_first_of(",\"\n\r") == std::string::npos ? text : quoted(text);
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) {
    throw std::invalid_argument("a spread needs a value");
  }
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values.back()};
}

double BenchRow::stage(const std::string& name) const {
  const auto found = std::ranges::find(stages, name, &std::pair<std::string, double>::first);
  return found == stages.end() ? 0.0 : found->second;
}

void set_times(BenchRow& row, std::span<const StageTimes> rounds) {
  std::vector<double> totals;
  for (const StageTimes& round : rounds) {
    double total = 0.0;
    for (const auto& [name, ms] : round) {
      total += ms;
    }
    totals.push_back(total);
  }
  row.ms = spread_of(std::move(totals));
  row.stages.clear();
  for (std::size_t s = 0; s < rounds.front().size(); ++s) {
    std::vector<double> times;
    for (const StageTimes& round : rounds) {
      times.push_back(round.at(s).second);
    }
    row.stages.emplace_back(rounds.front()[s].first, spread_of(std::move(times)).median);
  }
}

std::optional<double> paper_fps(const std::string& lens, const std::string& mode) {
  // In the order of kBenchLenses and kBenchModes.
  constexpr std::array<std::array<double, 4>, 5> kTable1{{{66.5, 70.5, 84.2, 83.5},
                                                          {42.5, 45.6, 56.1, 55.5},
                                                          {35.5, 38.7, 43.5, 43.1},
                                                          {31.7, 32.5, 38.2, 37.5},
                                                          {28.1, 28.8, 31.6, 30.8}}};
  const auto l = std::ranges::find(kBenchLenses, lens);
  const auto m = std::ranges::find(kBenchModes, mode);
  if (l == kBenchLenses.end() || m == kBenchModes.end()) {
    return std::nullopt;
  }
  return kTable1[static_cast<std::size_t>(l - kBenchLenses.begin())][static_cast<std::size_t>(m - kBenchModes.begin())];
}

double paper_ms(const BenchRow& row) {
  const auto fps = paper_fps(row.lens, row.mode);
  return fps ? 1000.0 / *fps * row.pixels() / (static_cast<double>(kPaperSize) * kPaperSize) : 0.0;
}

std::string rows_json(std::span<const BenchRow> rows, std::span<const PeerRow> peers) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const BenchRow& row : rows) {
    nlohmann::ordered_json j{
        {"lens", row.lens},           {"mode", row.mode},           {"size", row.size},
        {"triangles", row.triangles}, {"ms_median", row.ms.median}, {"ms_min", row.ms.min},
        {"ms_max", row.ms.max},       {"fps", row.fps()},           {"stages_ms", nlohmann::ordered_json::object()},
        {"device", row.device},       {"shading", row.shading},     {"processor_ms", row.cpu.median}};
    for (const auto& [name, ms] : row.stages) {
      j["stages_ms"][name] = ms;
    }
    if (const auto fps = paper_fps(row.lens, row.mode)) {
      j["paper_fps_at_1024"] = *fps;
    }
    if (const PeerRow* peer = peer_of(row, peers)) {
      j["embree16_rays"] = peer->rays;
      j["embree16_ms"] = peer->ms.median;
      j["embree16_processor_ms"] = peer->cpu.median;
    }
    list.push_back(std::move(j));
  }
  return list.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string rows_csv(std::span<const BenchRow> rows, std::span<const PeerRow> peers) {
  std::ostringstream out;
  out << "lens,mode,size,shading,triangles,ms_median,ms_min,ms_max,fps,processor_ms,rays_ms,tile_ms,ray_query_ms,trace_"
         "ms,"
         "edges_ms,blur_ms,samples_ms,encode_ms,embree16_ms,embree16_processor_ms,paper_fps_at_1024,device\n";
  for (const BenchRow& row : rows) {
    out << field(row.lens) << ',' << row.mode << ',' << row.size << ',' << row.shading << ',' << row.triangles << ','
        << row.ms.median << ',' << row.ms.min << ',' << row.ms.max << ',' << row.fps() << ',' << row.cpu.median;
    for (const char* stage : {"rays", "tile", "ray_query", "trace", "edges", "blur", "samples", "encode"}) {
      out << ',' << row.stage(stage);
    }
    const PeerRow* peer = peer_of(row, peers);
    out << ',' << (peer != nullptr ? std::to_string(peer->ms.median) : "") << ','
        << (peer != nullptr ? std::to_string(peer->cpu.median) : "") << ','
        << (paper_fps(row.lens, row.mode) ? std::to_string(*paper_fps(row.lens, row.mode)) : "") << ','
        << quoted(row.device) << '\n';
  }
  return out.str();
}

}  // namespace app
