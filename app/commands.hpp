// The program's commands: each adds its options to the command line and gives the action to run after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace app {

// What a command did with all its input: 0, or 2 if part of it was bad.
using Action = std::function<int()>;

[[nodiscard]] Action add_render_command(CLI::App& program);
[[nodiscard]] Action add_bench_command(CLI::App& program);
[[nodiscard]] Action add_measure_command(CLI::App& program);
[[nodiscard]] Action add_tradeoff_command(CLI::App& program);
[[nodiscard]] Action add_trace_command(CLI::App& program);
[[nodiscard]] Action add_vr_command(CLI::App& program);
[[nodiscard]] Action add_lens_command(CLI::App& program);

// The commands of `lens`, each in a file of its own.
[[nodiscard]] Action add_lens_from_prescription_command(CLI::App& lens);
[[nodiscard]] Action add_lens_from_sdf_command(CLI::App& lens);
[[nodiscard]] Action add_lens_to_sdf_command(CLI::App& lens);
[[nodiscard]] Action add_lens_from_oma_command(CLI::App& lens);
[[nodiscard]] Action add_lens_to_oma_command(CLI::App& lens);
[[nodiscard]] Action add_lens_check_command(CLI::App& lens);
[[nodiscard]] Action add_lens_progressive_command(CLI::App& lens);

}  // namespace app
