// vergence trace: rays in, wavefronts out, as JSON Lines.
#include <fstream>
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "app/device.hpp"
#include "lenses/lens_io/trace_io.hpp"
#include "lenses/trace.hpp"
#include "render/gpu_tracer.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

struct TraceOptions {
  std::string input = "-";
  std::string engine = "reference";
  std::string device;
  bool json = true;
};

// One line of the output in the making: an error, or the place of its ray in the batch.
struct Answer {
  std::string id_json;
  std::string error;
  std::size_t ray = 0;
  bool has_lens = false;
};

class TraceSession {
 public:
  TraceSession(const TraceOptions& options, std::istream& in)
      : options_(options), in_(in), lens_files_(base_folder(options.input)) {
    if (options.engine == "gpu") {
      device_ = std::make_unique<render::vk::Device>(open_device(options.device));
      tracer_ = std::make_unique<render::GpuTracer>(*device_);
    }
  }

  int run() {
    std::string line;
    while (std::getline(in_, line)) {
      ++line_number_;
      if (!line.empty() && line.back() == '\r') {
        line.pop_back();
      }
      take(line);
      // The reference answers at once; the GPU is worth its launch only in batches.
      const bool full = answers_.size() >= (device_ ? kBatchLines : 1) || batch_.model.table.size() >= kBatchTable;
      if (full) {
        flush();
      }
    }
    flush();
    if (in_.bad()) {
      throw InputError(options_.input == "-" ? "--input" : options_.input, "", "reading stopped before the end");
    }
    if (device_) {
      close_device(*device_);
    }
    if (bad_lines_ > 0) {
      std::cerr << "vergence: " << (options_.input == "-" ? "--input" : options_.input) << ": " << bad_lines_ << " of "
                << line_number_ << " lines are not valid rays; each has an \"error\" in its place\n";
      return 2;
    }
    return 0;
  }

 private:
  static constexpr std::size_t kBatchLines = 4096;
  static constexpr std::size_t kBatchTable = 1U << 20U;  // entries of spline coefficients

  static std::string base_folder(const std::string& input) {
    return input == "-" ? std::string(".") : std::filesystem::path(input).parent_path().string();
  }

  void take(const std::string& line) {
    Answer answer;
    try {
      const std::string file = options_.input == "-" ? "--input" : options_.input;
      const lenses::TraceRequest request = lenses::parse_trace_line(line, file, line_number_, lens_files_);
      answer.id_json = request.id_json;
      answer.has_lens = request.lens.has_value();
      lenses::append_request(batch_, request);
      answer.ray = batch_.rays.size() - 1;
    } catch (const InputError& error) {
      answer.id_json = lenses::trace_line_id(line);
      answer.error = error.what();
    } catch (const std::invalid_argument& error) {
      answer.id_json = lenses::trace_line_id(line);
      answer.error = "line " + std::to_string(line_number_) + ": lens: " + error.what();
    }
    bad_lines_ += answer.error.empty() ? 0 : 1;
    answers_.push_back(std::move(answer));
  }

  void flush() {
    std::vector<lenses::TraceResult> results;
    const auto collect = [&](const auto& records) {
      for (const Answer& answer : answers_) {
        if (answer.error.empty()) {
          results.push_back(lenses::to_result(records[answer.ray], batch_.rays[answer.ray], answer.has_lens));
        }
      }
    };
    if (device_) {
      collect(tracer_->trace(batch_));
    } else {
      collect(lenses::trace_reference(batch_));
    }
    std::size_t next = 0;
    for (const Answer& answer : answers_) {
      std::cout << (answer.error.empty() ? lenses::format_trace_result(answer.id_json, results[next++])
                                         : lenses::format_trace_error(answer.id_json, answer.error))
                << '\n';
    }
    std::cout.flush();
    if (!std::cout) {
      throw std::runtime_error("standard output: cannot be written");
    }
    answers_.clear();
    lenses::next_batch(batch_);
  }

  const TraceOptions& options_;
  std::istream& in_;
  lenses::LensCache lens_files_;
  std::unique_ptr<render::vk::Device> device_;
  std::unique_ptr<render::GpuTracer> tracer_;
  lenses::TraceBatch batch_;
  std::vector<Answer> answers_;
  std::size_t line_number_ = 0;
  std::size_t bad_lines_ = 0;
};

int trace(const TraceOptions& options) {
  if (options.input == "-") {
    return TraceSession(options, std::cin).run();
  }
  std::ifstream file(options.input);
  if (!file || std::filesystem::is_directory(options.input)) {
    throw InputError(options.input, "", "cannot be read; a file of JSON Lines is expected");
  }
  return TraceSession(options, file).run();
}

}  // namespace

Action add_trace_command(CLI::App& program) {
  auto options = std::make_shared<TraceOptions>();
  CLI::App* command = program.add_subcommand("trace", "Rays in, wavefronts out, as JSON Lines");
  command->footer(
      "Example:\n"
      "  echo '{\"id\": 1, \"lens\": null, \"direction\": [0, 0, -1], \"object_distance_m\": 0.4}' | vergence trace\n"
      "Each line in is one ray, each line out its wavefront at the pupil, in the same order. A bad line gets an\n"
      "\"error\" in its place and the exit status becomes 2.");
  command->add_option("--input", options->input, "File of JSON Lines; - is standard input")->capture_default_str();
  command->add_option("--engine", options->engine, "reference (double precision, CPU) or gpu (the renderer's shaders)")
      ->check(CLI::IsMember({"reference", "gpu"}))
      ->capture_default_str();
  command->add_option("--device", options->device, "GPU by name or index");
  command->add_flag("--json", options->json, "Accepted as by every command; trace always answers in JSON");
  return [options] { return trace(*options); };
}

}  // namespace app
