// vergence lens: makes, converts and checks lens files, each by a command of its own.
#include <map>
#include <memory>
#include <string>

#include "app/commands.hpp"

namespace app {

Action add_lens_command(CLI::App& program) {
  CLI::App* lens = program.add_subcommand("lens", "Make, convert and check lens files");
  lens->require_subcommand(1);
  lens->footer(
      "Example: vergence lens from-prescription --sphere -2.25 --cylinder -0.75 --axis 175 --output right.json\n"
      "vergence lens COMMAND --help shows a command's options.");
  auto actions = std::make_shared<std::map<std::string, Action>>();
  (*actions)["from-prescription"] = add_lens_from_prescription_command(*lens);
  (*actions)["from-sdf"] = add_lens_from_sdf_command(*lens);
  (*actions)["to-sdf"] = add_lens_to_sdf_command(*lens);
  (*actions)["from-oma"] = add_lens_from_oma_command(*lens);
  (*actions)["to-oma"] = add_lens_to_oma_command(*lens);
  (*actions)["check"] = add_lens_check_command(*lens);
  (*actions)["progressive"] = add_lens_progressive_command(*lens);
  return [lens, actions] { return actions->at(lens->get_subcommands().front()->get_name())(); };
}

}  // namespace app
