// vergence lens check: what is wrong with lenses, spectacles and jobs.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <variant>
#include <vector>

#include "app/commands.hpp"
#include "app/lens_file_options.hpp"
#include "app/option_values.hpp"
#include "lenses/lens_check.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_or_spectacles.hpp"
#include "lenses/lens_io/oma_spectacles.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using lenses::Lens;
using lenses::Side;
using nlohmann::ordered_json;

constexpr int kBadLens = 2;

struct CheckOptions {
  std::vector<std::string> files;
  std::string side = "right";
  std::optional<double> min_edge, min_centre;
  double coarse_net = lenses::LensCheckLimits{}.coarse_net;
  bool json = false;
};

// A lens of a file, or why there is none.
struct Checked {
  std::string file, lens;  // lens: "right", "left", or "" for a file of one
  std::string error;
  lenses::LensCheck check;
  [[nodiscard]] bool fine() const { return error.empty() && check.findings.empty(); }
  [[nodiscard]] std::string name() const { return lens.empty() ? file : file + ": " + lens; }
};

std::variant<Lens, lenses::Spectacles> read_any(const std::string& file) {
  if (lenses::sag_format_of(file)) return lenses::spectacles_of(lenses::io::read_oma(file)).spectacles;
  return lenses::read_lens_or_spectacles(file);
}

Checked checked(const std::string& file, const std::string& name, const Lens& lens, Side side,
                const lenses::LensCheckLimits& limits) {
  Checked result{file, name, {}, {}};
  try {
    result.check = check_lens(lens, side, limits);
  } catch (const std::invalid_argument& error) {
    result.error = error.what();  // a parametric patch that folds over
  }
  return result;
}

std::vector<Checked> check_file(const std::string& file, Side side, const lenses::LensCheckLimits& limits) {
  try {
    const auto read = read_any(file);
    if (const auto* lens = std::get_if<Lens>(&read)) return {checked(file, "", *lens, side, limits)};
    const auto& pair = std::get<lenses::Spectacles>(read);
    return {checked(file, "right", pair.lens[0], Side::right, limits),
            checked(file, "left", pair.lens[1], Side::left, limits)};
  } catch (const tracking::InputError& error) {
    const std::string what = error.field().empty() ? error.reason() : error.field() + ": " + error.reason();
    return {{error.file(), "", what, {}}};
  }
}

std::string text_of(const Checked& c) {
  if (!c.error.empty()) return c.name() + ": " + c.error + "\n";
  std::string text;
  for (const lenses::LensFinding& finding : c.check.findings) {
    text += c.name() + ": " + finding.field + ": " + finding.message + "\n";
  }
  if (!text.empty()) return text;
  const auto mm = [](const std::optional<double>& metres) { return metres ? shown_text(1e3 * *metres, 3) : "?"; };
  text = c.name() + ": fine; " + mm(c.check.centre_thickness) + " mm in the centre, edge " + mm(c.check.thinnest_edge) +
         " to " + mm(c.check.thickest_edge) + " mm";
  if (c.check.eye_clearance) text += ", " + mm(c.check.eye_clearance) + " mm from the eye";
  return text + "\n";
}

ordered_json json_of(const Checked& c) {
  ordered_json result{
      {"file", c.file}, {"lens", c.lens.empty() ? ordered_json() : ordered_json(c.lens)}, {"fine", c.fine()}};
  if (!c.error.empty()) {
    result["error"] = c.error;
    return result;
  }
  const auto number = [](const std::optional<double>& value, double unit) {
    return value ? ordered_json(shown(unit * *value, 5)) : ordered_json();
  };
  result["centre_thickness_mm"] = number(c.check.centre_thickness, 1e3);
  result["thinnest_mm"] = number(c.check.thinnest, 1e3);
  result["thinnest_edge_mm"] = number(c.check.thinnest_edge, 1e3);
  result["thickest_edge_mm"] = number(c.check.thickest_edge, 1e3);
  result["eye_clearance_mm"] = number(c.check.eye_clearance, 1e3);
  result["front_net_error_D"] = number(c.check.front_net_error, 1.0);
  result["back_net_error_D"] = number(c.check.back_net_error, 1.0);
  result["findings"] = ordered_json::array();
  for (const lenses::LensFinding& finding : c.check.findings) {
    ordered_json one{{"fault", name_of(finding.fault)},
                     {"field", finding.field},
                     {"message", finding.message},
                     {"value", shown(finding.value, 5)},
                     {"limit", shown(finding.limit, 5)}};
    if (finding.at) one["at_mm"] = {shown(1e3 * finding.at->x, 5), shown(1e3 * finding.at->y, 5)};
    result["findings"].push_back(std::move(one));
  }
  return result;
}

int check(const CheckOptions& options) {
  lenses::LensCheckLimits limits;
  if (options.min_edge) {
    check_range("--min-edge", *options.min_edge, 0.0, 20.0, "mm");
    limits.least_edge = *options.min_edge / 1e3;
  }
  if (options.min_centre) {
    check_range("--min-centre", *options.min_centre, 0.0, 20.0, "mm");
    limits.least_centre = *options.min_centre / 1e3;
  }
  check_range("--coarse-net", options.coarse_net, 0.0, 10.0, "D");
  limits.coarse_net = options.coarse_net;
  const Side side = options.side == "right" ? Side::right : Side::left;
  std::size_t lens_count = 0, bad = 0;
  std::string text;
  ordered_json list = ordered_json::array();
  for (const std::string& file : options.files) {
    for (const Checked& one : check_file(file, side, limits)) {
      ++lens_count;
      bad += one.fine() ? 0 : 1;
      if (options.json) {
        list.push_back(json_of(one));
      } else {
        text += text_of(one);
      }
    }
  }
  print_text(options.json ? lenses::io::document_text(list) : text);
  if (bad == 0) return 0;
  std::cerr << "vergence: FILE: " << bad << " of " << lens_count
            << " lenses have faults; each is named on standard output\n";
  return kBadLens;
}

}  // namespace

Action add_lens_check_command(CLI::App& lens) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = lens.add_subcommand("check", "What is wrong with lenses, if anything");
  command->footer(
      "Example: vergence lens check spectacles.json --min-edge 1.0\n"
      "Named: surfaces that cross or end inside the outline, an edge or glass too thin, a control net too coarse for "
      "its\n"
      "curvature, an outline beyond the diameter, a lens that would touch the eye, the brow or the cheek, reference "
      "points\n"
      "outside the outline. Exit status 0 when every lens is fine, 2 when one is not.");
  command->add_option("FILE", options->files, "Lens, spectacles or job files")->required();
  command->add_option("--side", options->side, "Eye that single lenses are for: right or left")
      ->check(CLI::IsMember({"right", "left"}))
      ->capture_default_str();
  command->add_option("--min-edge", options->min_edge, "Least edge thickness, mm (0.8; uncut 0.5, contact 0.03)");
  command->add_option("--min-centre", options->min_centre, "Least thickness elsewhere, mm (0.8; contact 0.03)");
  command->add_option("--coarse-net", options->coarse_net, "Power by which a spline may be off its smooth surface, D")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Report as JSON");
  return [options] { return check(*options); };
}

}  // namespace app
