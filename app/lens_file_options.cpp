#include "app/lens_file_options.hpp"

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "app/option_values.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "render/image/output_file.hpp"

namespace app {
namespace {

const std::map<std::string, lenses::SagFormat> kFormats{
    {"sdf", lenses::SagFormat::sdf}, {"hmf", lenses::SagFormat::hmf}, {"xyz", lenses::SagFormat::xyz}};

template <class Value>
std::optional<Value> chosen(const std::string& word, const std::string& first, Value if_first, Value otherwise) {
  if (word.empty()) return std::nullopt;
  return word == first ? if_first : otherwise;
}

}  // namespace

lenses::RowOrder SagOptions::row_order() const {
  return rows == "top" ? lenses::RowOrder::top_first : lenses::RowOrder::bottom_first;
}

std::optional<lenses::SagFormat> SagOptions::sag_format() const {
  return format.empty() ? std::nullopt : std::optional(kFormats.at(format));
}

std::optional<lenses::Side> SagOptions::chosen_side() const {
  return chosen(side, "right", lenses::Side::right, lenses::Side::left);
}

std::optional<lenses::Face> SagOptions::chosen_face() const {
  return chosen(surface, "front", lenses::Face::front, lenses::Face::back);
}

lenses::SplineFitConfig SagOptions::fit_config() const {
  lenses::SplineFitConfig config;
  if (smoothing_um) {
    check_range("--smoothing", *smoothing_um, 0.0, 100.0, "um");
    config.noise = *smoothing_um / 1e6;
  }
  return config;
}

void add_rows_option(CLI::App& command, SagOptions& options) {
  command.add_option("--rows", options.rows, "Row that comes first in a table: top or bottom")
      ->check(CLI::IsMember({"top", "bottom"}))
      ->capture_default_str();
}

void add_smoothing_option(CLI::App& command, SagOptions& options) {
  command.add_option("--smoothing", options.smoothing_um,
                     "Error of the heights to smooth away, um rms (what their digits leave)");
}

void add_format_option(CLI::App& command, SagOptions& options) {
  command.add_option("--format", options.format, "sdf, hmf or xyz (by the file's ending)")
      ->check(CLI::IsMember({"sdf", "hmf", "xyz"}));
}

void add_surface_options(CLI::App& command, SagOptions& options, const std::string& side_help,
                         const std::string& surface_help) {
  command.add_option("--side", options.side, side_help)->check(CLI::IsMember({"right", "left"}));
  command.add_option("--surface", options.surface, surface_help)->check(CLI::IsMember({"front", "back"}));
}

double shown(double value, int digits) {
  return lenses::io::rounded(value, digits);
}

std::string shown_text(double value, int digits) {
  return lenses::io::number_text(shown(value, digits));
}

nlohmann::ordered_json fit_report(const lenses::SplineFit& fit, double index) {
  return {{"samples", fit.samples},
          {"controls", {fit.surface.count_x(), fit.surface.count_y()}},
          {"noise_um", shown(1e6 * fit.noise)},
          {"residual_rms_um", shown(1e6 * fit.residual_rms)},
          {"residual_max_um", shown(1e6 * fit.residual_max)},
          {"power_noise_D", shown(fit.power_noise(index))},
          {"cylinder_noise_D", shown(fit.cylinder_noise(index))}};
}

std::string fit_text(const lenses::SplineFit& fit, double index) {
  return std::to_string(fit.samples) + " heights, net " + std::to_string(fit.surface.count_x()) + " x " +
         std::to_string(fit.surface.count_y()) + ", residual " + shown_text(1e6 * fit.residual_rms, 3) + " um rms, " +
         shown_text(1e6 * fit.residual_max, 3) + " um at most (rounding " + shown_text(1e6 * fit.noise, 3) +
         " um rms), which leaves " + shown_text(fit.power_noise(index), 2) + " D of power and " +
         shown_text(fit.cylinder_noise(index), 2) + " D of cylinder open";
}

void write_text(const std::string& path, const std::string& text) {
  render::write_file(path, std::as_bytes(std::span(text)));
}

void print_text(const std::string& text) {
  std::cout << text;
  std::cout.flush();
  if (!std::cout) throw std::runtime_error("standard output: cannot be written");
}

}  // namespace app
