// What the commands around lens files share: words of options, the surface's report, output.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lenses/lens_io/sag_file.hpp"

namespace app {

// Options that say how a tabulated surface is read.
struct SagOptions {
  std::string rows = "top", format, side, surface;
  std::optional<double> smoothing_um;

  [[nodiscard]] lenses::RowOrder row_order() const;
  [[nodiscard]] std::optional<lenses::SagFormat> sag_format() const;
  [[nodiscard]] std::optional<lenses::Side> chosen_side() const;
  [[nodiscard]] std::optional<lenses::Face> chosen_face() const;
  [[nodiscard]] lenses::SplineFitConfig fit_config() const;  // checks --smoothing
};

void add_rows_option(CLI::App& command, SagOptions& options);
void add_smoothing_option(CLI::App& command, SagOptions& options);
void add_format_option(CLI::App& command, SagOptions& options);
void add_surface_options(CLI::App& command, SagOptions& options, const std::string& side_help,
                         const std::string& surface_help);

// How far a fitted surface lies from its table, and what the table's rounding leaves: um, and D in a lens of this
// index.
[[nodiscard]] nlohmann::ordered_json fit_report(const lenses::SplineFit& fit, double index);
[[nodiscard]] std::string fit_text(const lenses::SplineFit& fit, double index);

// To so many significant digits.
[[nodiscard]] double shown(double value, int digits = 4);
[[nodiscard]] std::string shown_text(double value, int digits = 4);

// Writes the text whole or not at all.
void write_text(const std::string& path, const std::string& text);
// To standard output; throws when nobody can read it.
void print_text(const std::string& text);

}  // namespace app
