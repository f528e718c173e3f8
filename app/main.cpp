// The program: one command, one exit status. Only here are errors caught and printed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "render/vk/device.hpp"
#include "tracking/input_error.hpp"

namespace {

constexpr int kFailed = 1, kBadInput = 2;

// One line, whatever a message holds.
int report(std::string message, int status) {
  std::ranges::replace_if(
      message, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::cerr << "vergence: " << message << '\n';
  return status;
}

// The command as it was given, down to the last of nested ones: its words, and where its options are.
struct ChosenCommand {
  const CLI::App* app;
  std::string words;
};

ChosenCommand chosen_command(const CLI::App& program) {
  ChosenCommand chosen{&program, program.get_name()};
  for (auto below = program.get_subcommands(); !below.empty(); below = chosen.app->get_subcommands()) {
    chosen = {below.front(), chosen.words + " " + below.front()->get_name()};
  }
  return chosen;
}

// What CLI11 found wrong on the command line, with the option (or the word that is none) in front.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const auto [chosen, command] = chosen_command(program);
  // A command that is only a family of commands takes one of them, not options.
  const bool family = chosen->get_require_subcommand_min() > 0;
  const std::string help = "; see " + command + " --help";
  const std::string message = error.what();
  const std::vector<std::string> rest = program.remaining(true);
  if (!rest.empty() && (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr || family)) {
    const bool option = rest.front().starts_with('-');
    return (rest.front().empty() ? "''" : rest.front()) + ": is not " +
           (option   ? "an option of " + command
            : family ? (chosen == &program ? "a command" : "a command of " + command)
                     : "expected; " + command + " takes options only") +
           help;
  }
  if (family && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return "COMMAND: is missing; one is needed" + help;
  }
  // "FILE is required"
  if (const std::size_t required = message.find(" is required");
      required != std::string::npos && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return message.substr(0, required) + ": is missing; " + command + " needs it" + help;
  }
  // "Could not convert: --fov = abc"
  if (const std::size_t equals = message.find(" = ");
      dynamic_cast<const CLI::ConversionError*>(&error) != nullptr && equals != std::string::npos) {
    const std::string option = message.substr(message.find('-'), equals - message.find('-'));
    const CLI::Option* known = chosen->get_option_no_throw(option);
    const bool whole = known != nullptr && known->get_type_name() != "FLOAT";
    return option + ": '" + message.substr(equals + 3) + "' is not a " +
           (whole ? "whole number in its range" : "number") + help;
  }
  // "--gaze excludes --look-at"
  if (const std::size_t excludes = message.find(" excludes "); excludes != std::string::npos) {
    return message.substr(0, excludes) + ": cannot be given together with " +
           message.substr(excludes + std::string_view(" excludes ").size()) + help;
  }
  return message + help;
}

// An unset shell variable must not pass for "as by default".
void refuse_empty_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (std::ranges::count(option->results(), std::string()) > 0) {
      throw tracking::InputError(option->get_name(), "", "is empty; a value is needed, or leave the option out");
    }
  }
}

// --help and --version, which fail as any output does when nobody can read it.
int print(const CLI::App& program, const CLI::ParseError& wish) {
  const int status = program.exit(wish);
  std::cout.flush();
  return std::cout ? status : report("standard output: cannot be written", kFailed);
}

int run(int argc, char** argv) {
  CLI::App program("Vergence: what each eye sees through its own spectacles. Not a medical device.", "vergence");
  program.set_version_flag("--version", VERGENCE_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit status: 0 done, 1 failed at run time (GPU, disk), 2 bad input or usage.\n"
      "Example: vergence render --look-at near_card --output near.png");
  std::map<std::string, app::Action> actions;
  actions["render"] = app::add_render_command(program);
  actions["bench"] = app::add_bench_command(program);
  actions["measure"] = app::add_measure_command(program);
  actions["tradeoff"] = app::add_tradeoff_command(program);
  actions["trace"] = app::add_trace_command(program);
  actions["vr"] = app::add_vr_command(program);
  actions["lens"] = app::add_lens_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return print(program, help);
  } catch (const CLI::CallForVersion& version) {
    return print(program, version);
  } catch (const CLI::ParseError& error) {
    return report(usage_message(program, error), kBadInput);
  }
  refuse_empty_values(*chosen_command(program).app);
  return actions.at(program.get_subcommands().front()->get_name())();
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is a failed write, not a death
  try {
    return run(argc, argv);
  } catch (const tracking::InputError& error) {
    return report(error.what(), kBadInput);
  } catch (const render::vk::DeviceError& error) {
    return report(std::string("--device: ") + error.what(), kFailed);
  } catch (const std::bad_alloc&) {
    return report("memory: not enough for this input", kFailed);
  } catch (const std::exception& error) {
    return report(error.what(), kFailed);
  }
}
