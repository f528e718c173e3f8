// The program: one command, one exit status. Only here are errors caught and printed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "app/commands.hpp"
#include "tracking/input_error.hpp"

namespace {

constexpr int kFailed = 1, kBadInput = 2;

// One line, whatever a message holds.
int report(std::string message, int status) {
  std::ranges::replace_if(message, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::cerr << "vergence: " << message << '\n';
  return status;
}

// CLI11's "--size: 1 required TEXT missing" and the like, with the option in front.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto selected = program.get_subcommands();
  const std::string help =
      selected.empty() ? "vergence --help" : "vergence " + selected.front()->get_name() + " --help";
  return std::string(error.what()) + "; see " + help;
}

int run(int argc, char** argv) {
  CLI::App program("Vergence: what each eye sees through its own spectacles. Not a medical device.");
  program.set_version_flag("--version", VERGENCE_VERSION);
  program.require_subcommand(1);
  program.footer("Exit status: 0 done, 1 failed at run time (GPU, disk), 2 bad input or usage.\n"
                 "Example: vergence render --look-at near_card --output near.png");
  std::map<std::string, app::Action> actions;
  actions["render"] = app::add_render_command(program);
  actions["trace"] = app::add_trace_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return program.exit(help);
  } catch (const CLI::CallForVersion& version) {
    return program.exit(version);
  } catch (const CLI::ParseError& error) {
    return report(usage_message(program, error), kBadInput);
  }
  return actions.at(program.get_subcommands().front()->get_name())();
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is a failed write, not a death
  try {
    return run(argc, argv);
  } catch (const tracking::InputError& error) {
    return report(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return report("memory: not enough for this input", kFailed);
  } catch (const std::exception& error) {
    return report(error.what(), kFailed);
  }
}
