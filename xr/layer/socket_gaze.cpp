#include "xr/layer/socket_gaze.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

#include "tracking/gaze_trace_columns.hpp"
#include "tracking/input_error.hpp"

namespace xr::layer {
namespace {

constexpr std::size_t kLongestLine = 4096;  // bytes; a full line of doubles has about 400
constexpr double kOldestLine = 10.0;        // s: what is older was not stamped with this machine's clock

double monotonic_now() {
  std::timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

class File {
 public:
  explicit File(int file) : file_(file) {}
  ~File() {
    if (file_ >= 0) {
      close(file_);
    }
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] int get() const { return file_; }

 private:
  int file_;
};

std::string standard_header() {
  std::string text;
  for (const std::string_view name : tracking::kTraceColumns) {
    text.append(name).push_back(',');
  }
  text.back() = '\n';
  return text;
}

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) {
    throw tracking::InputError("VERGENCE_GAZE_SOCKET", "",
                               "a socket's path has 1 to " + std::to_string(sizeof(address.sun_path) - 1) + " bytes");
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

}  // namespace

SocketGaze::SocketGaze(Config config) : config_(std::move(config)) {
  static_cast<void>(address_of(config_.path));
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_ < 0) {
    throw tracking::InputError("VERGENCE_GAZE_SOCKET", "", std::string("no eventfd: ") + std::strerror(errno));
  }
  // The program's signals are not for this thread.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  } catch (...) {
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    close(wake_);
    throw;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

SocketGaze::~SocketGaze() {
  thread_.request_stop();
  const std::uint64_t one = 1;
  // An eventfd that is not full takes it at once; there is nobody to tell if it did not.
  [[maybe_unused]] const ssize_t written = write(wake_, &one, sizeof(one));
  thread_.join();
  close(wake_);
}

bool SocketGaze::present() const {
  const std::lock_guard lock(mutex_);
  return connected_;
}

GazeReading SocketGaze::at(XrTime time, XrTime /*start*/) const {
  std::optional<tracking::TraceRow> last;
  {
    const std::lock_guard lock(mutex_);
    last = last_;
  }
  if (!last || !last->gaze_valid) {
    return {};
  }
  const double age = monotonic_now() - last->time;
  if (age > config_.longest_silence) {
    return {};
  }
  // A runtime that cannot tell its time: as old against the time asked for as it is against now.
  const auto guessed = time - static_cast<XrTime>(age * 1e9);
  return {.valid = true,
          .direction = last->gaze,
          .sample_time = config_.time_of_monotonic ? config_.time_of_monotonic(last->time).value_or(guessed) : guessed};
}

void SocketGaze::run(const std::stop_token& stop) {
  const sockaddr_un address = address_of(config_.path);
  const int retry = static_cast<int>(config_.retry * 1e3);
  while (!stop.stop_requested()) {
    const File socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (socket.get() >= 0 && connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
      converse(socket.get(), stop);
      lose(false);
    } else {
      report_once(reported_connection_,
                  config_.path + ": " + std::strerror(errno) + "; somebody has to listen there. Trying again");
    }
    static_cast<void>(wait_for(-1, retry, stop));
  }
}

bool SocketGaze::wait_for(int file, int milliseconds, const std::stop_token& stop) const {
  std::array<pollfd, 2> files{pollfd{wake_, POLLIN, 0}, pollfd{file, POLLIN, 0}};
  poll(files.data(), file < 0 ? 1 : 2, milliseconds);
  return !stop.stop_requested();
}

void SocketGaze::converse(int socket, const std::stop_token& stop) {
  {
    const std::lock_guard lock(mutex_);
    connected_ = true;
  }
  header_ = standard_header();
  std::string pending;
  std::array<char, kLongestLine> bytes;
  while (wait_for(socket, -1, stop)) {
    const ssize_t count = read(socket, bytes.data(), bytes.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
      continue;
    }
    if (count <= 0) {
      return;
    }
    pending.append(bytes.data(), static_cast<std::size_t>(count));
    for (auto end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
      take(pending.substr(0, end));
      pending.erase(0, end + 1);
    }
    if (pending.size() > kLongestLine) {
      report_once(reported_line_, config_.path + ": a line longer than " + std::to_string(kLongestLine) +
                                      " bytes; gaze is lost until the next good one");
      lose(true);
      pending.clear();
    }
  }
}

void SocketGaze::take(const std::string& line) {
  if (line.starts_with("time_s")) {
    header_ = line + "\n";
    return;
  }
  try {
    tracking::TraceRow row = tracking::parse_gaze_trace(header_ + line + "\n", config_.path).rows.front();
    const double now = monotonic_now();
    // 0: the sender leaves the time to us.
    row.time = row.time == 0.0 ? now : row.time;
    if (!(row.time <= now && row.time > now - kOldestLine)) {
      throw tracking::InputError(config_.path, "time_s",
                                 "is not CLOCK_MONOTONIC in seconds, at most " +
                                     std::to_string(static_cast<int>(kOldestLine)) + " s ago; 0 stands for now");
    }
    const std::lock_guard lock(mutex_);
    last_ = row;
  } catch (const tracking::InputError& error) {
    report_once(reported_line_, std::string(error.what()) + "; gaze is lost until the next good line");
    lose(true);
  }
}

void SocketGaze::lose(bool connected) {
  const std::lock_guard lock(mutex_);
  last_.reset();
  connected_ = connected;
}

void SocketGaze::report_once(bool& reported, const std::string& text) const {
  if (!std::exchange(reported, true) && config_.report) {
    config_.report(text);
  }
}

}  // namespace xr::layer
