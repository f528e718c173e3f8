// A Monado of the test's own: its service in a private runtime directory, and an environment in which OpenXR programs
// of this process, and its children, find it.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace support {

struct MonadoConfig {
  // False: the compositor that shows nothing and reads no pixels, at 20 Hz. True: in a window of the X server of
  // DISPLAY.
  bool visible = false;
  // The headset that is told its poses (remote_head.hpp) instead of the simulated one, which wobbles by the clock.
  bool remote = false;
};

class Monado {
 public:
  static constexpr int kRemotePort = 4243;  // in a network namespace of the test's own

  explicit Monado(const MonadoConfig& config = {}) : config_(config) {
    std::string pattern = (std::filesystem::temp_directory_path() / "vergence-monado-XXXXXX").string();
    if (!mkdtemp(pattern.data())) {
      throw std::runtime_error("no temporary directory");
    }
    folder_ = pattern;
    setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
    setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
    setenv("XR_RUNTIME_JSON", VERGENCE_MONADO "/share/openxr/1/openxr_monado.json", 1);
    if (config.remote) {
      std::filesystem::create_directory(folder_ / "monado");
      std::ofstream(folder_ / "monado" / "config_v0.json")
          << R"({"active": "remote", "remote": {"version": 0, "port": )" << kRemotePort << R"(, "view_count": 2}})";
    }
    start();
  }

  ~Monado() {
    kill();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  Monado(const Monado&) = delete;
  Monado& operator=(const Monado&) = delete;

  // As a crash would.
  void kill() {
    if (service_ > 0) {
      ::kill(service_, SIGKILL);
      waitpid(service_, nullptr, 0);
      service_ = -1;
    }
  }

  void start() {
    std::error_code ignored;
    std::filesystem::remove(socket(), ignored);
    service_ = fork();
    if (service_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      run_service();
    }
    for (int tries = 0; tries < 400; ++tries) {  // 20 s: it takes 0.2 s on an idle machine
      if (answers()) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    throw std::runtime_error("monado-service does not answer; cmake/monado.sh lays it down. It said:\n" + said());
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  [[nodiscard]] std::string said() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "log").rdbuf();
    return text.str();
  }

 private:
  [[noreturn]] void run_service() const {
    setenv(config_.visible ? "XRT_COMPOSITOR_FORCE_XCB" : "XRT_COMPOSITOR_NULL", "1", 1);
    setenv("XRT_COMPOSITOR_SCALE_PERCENTAGE", "30", 1);
    if (!config_.remote) {
      setenv("SIMULATED_ENABLE", "1", 1);
    }
    setenv("XRT_NO_STDIN", "1", 1);
    unsetenv("XR_ENABLE_API_LAYERS");
    if (!freopen((folder_ / "log").c_str(), "w", stderr) || !freopen("/dev/null", "w", stdout)) {
      _exit(126);
    }
    const std::string program = VERGENCE_MONADO "/bin/monado-service";
    execl(program.c_str(), program.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }

  [[nodiscard]] std::filesystem::path socket() const { return folder_ / "monado_comp_ipc"; }

  [[nodiscard]] bool answers() const {
    const int file = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket().c_str(), sizeof(address.sun_path) - 1);
    const bool connected = connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
    close(file);
    return connected;
  }

  MonadoConfig config_;
  std::filesystem::path folder_;
  pid_t service_ = -1;
};

}  // namespace support
