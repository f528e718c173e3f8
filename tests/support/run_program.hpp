// The built program as a child process: what it said, how it ended, how long it took.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace support {

struct ProgramResult {
  int exit_status = -1;  // -1: ended by a signal
  int signal = 0;
  bool timed_out = false;
  std::string out, err;
};

struct ProgramCall {
  std::vector<std::string> arguments;
  std::string input = {};                                             // on standard input
  std::vector<std::pair<std::string, std::string>> environment = {};  // beyond this process's own
  std::string standard_output = {};                                   // a file to write to instead of a pipe
  std::filesystem::path folder = {};                                  // to run in; empty: where the test runs
  std::chrono::seconds time_limit{60};
};

namespace run_program_detail {

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error("no pipe");
    }
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] int end(std::size_t i) const { return ends_[i]; }
  void close_end(std::size_t i) {
    if (ends_[i] >= 0) {
      ::close(ends_[i]);
      ends_[i] = -1;
    }
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

[[noreturn]] inline void become(const ProgramCall& call, const Pipe& in, const Pipe& out, const Pipe& err) {
  ::dup2(in.end(0), STDIN_FILENO);
  ::dup2(call.standard_output.empty() ? out.end(1) : ::open(call.standard_output.c_str(), O_WRONLY), STDOUT_FILENO);
  ::dup2(err.end(1), STDERR_FILENO);
  if (!call.folder.empty() && ::chdir(call.folder.c_str()) != 0) {
    ::_exit(126);
  }
  for (const auto& [name, value] : call.environment) {
    ::setenv(name.c_str(), value.c_str(), 1);
  }
  std::string program = VERGENCE_PROGRAM;
  std::vector<std::string> words = call.arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  ::execv(program.c_str(), argv.data());
  ::_exit(127);
}

// Feeds the input and gathers both outputs until they end or time is up.
inline bool converse(const ProgramCall& call, Pipe& in, Pipe& out, Pipe& err, ProgramResult& result) {
  const auto stop = std::chrono::steady_clock::now() + call.time_limit;
  std::size_t written = 0;
  if (call.input.empty()) {
    in.close_end(1);
  }
  while (out.end(0) >= 0 || err.end(0) >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(stop - std::chrono::steady_clock::now());
    std::array<pollfd, 3> ends{pollfd{in.end(1), POLLOUT, 0}, pollfd{out.end(0), POLLIN, 0},
                               pollfd{err.end(0), POLLIN, 0}};
    if (left.count() <= 0 || ::poll(ends.data(), ends.size(), static_cast<int>(left.count())) == 0) {
      return false;
    }
    if (ends[0].revents != 0) {
      const ssize_t n =
          ::write(in.end(1), call.input.data() + written, std::min<std::size_t>(call.input.size() - written, 4096));
      written += n > 0 ? static_cast<std::size_t>(n) : 0;
      if (n <= 0 || written == call.input.size()) {
        in.close_end(1);
      }
    }
    for (const std::size_t i : {1U, 2U}) {
      Pipe& pipe = i == 1 ? out : err;
      if (ends[i].revents == 0) {
        continue;
      }
      std::array<char, 65536> text{};
      const ssize_t n = ::read(pipe.end(0), text.data(), text.size());
      if (n <= 0) {
        pipe.close_end(0);
      } else {
        (i == 1 ? result.out : result.err).append(text.data(), static_cast<std::size_t>(n));
      }
    }
  }
  return true;
}

}  // namespace run_program_detail

// Runs the program to its end; one that passes its time is killed.
inline ProgramResult run_program(const ProgramCall& call) {
  namespace detail = run_program_detail;
  std::signal(SIGPIPE, SIG_IGN);  // a program that ends before it has read all is its own affair
  detail::Pipe in;
  detail::Pipe out;
  detail::Pipe err;
  const pid_t child = ::fork();
  if (child < 0) {
    throw std::runtime_error("no child process");
  }
  if (child == 0) {
    detail::become(call, in, out, err);
  }
  in.close_end(0);
  out.close_end(1);
  err.close_end(1);
  ProgramResult result;
  if (!detail::converse(call, in, out, err, result)) {
    result.timed_out = true;
    ::kill(child, SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  result.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return result;
}

// An empty folder that goes with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vergence-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("no temporary folder");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      all.push_back(entry.path().filename().string());
    }
    std::ranges::sort(all);
    return all;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace support
