// vergence lens from-prescription: a lens file from what an optician orders.
#include <iostream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "app/commands.hpp"
#include "app/prescription_options.hpp"
#include "app/prescription_report.hpp"
#include "lenses/design/prescription_lens.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

int make_lens(const PrescriptionOptions& options) {
  const RequestedLens requested = requested_lens(options);
  PrescriptionReport report{options.output, {}, requested.density};
  try {
    report.designed = lenses::design_lens(requested.request);
  } catch (const lenses::DesignError& error) {
    throw tracking::InputError(option_of(error.field()), "", error.reason());
  }
  const std::string text = lenses::to_json(report.designed.lens);
  render::write_file(options.output, std::as_bytes(std::span(text)));
  std::cout << (options.json ? to_json(report) : to_table(report));
  std::cout.flush();
  if (!std::cout) {
    throw std::runtime_error("standard output: cannot be written");
  }
  return 0;
}

}  // namespace

Action add_lens_from_prescription_command(CLI::App& lens) {
  auto options = std::make_shared<PrescriptionOptions>();
  CLI::App* command = lens.add_subcommand("from-prescription", "A lens file from what an optician orders");
  command->footer(
      "Examples:\n"
      "  vergence lens from-prescription --sphere -2.25 --cylinder -0.75 --axis 175 --prism 1@in --side right \\\n"
      "    --material MR-8 --output right.json\n"
      "  vergence lens from-prescription --sphere 2 --add 2.25 --design bifocal --segment ft28 --output near.json\n"
      "A lensmeter reads the order, unless --as-worn shapes the lens so that the wearer gets it; the report says "
      "both.");
  add_prescription_options(*command, *options);
  return [options] { return make_lens(*options); };
}

}  // namespace app
