#include "render/image/output_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "render/image/output_error.hpp"

namespace render {
namespace {

// Process and count make it unique among all that write beside the same target.
std::filesystem::path temporary_beside(const std::filesystem::path& target) {
  static std::atomic<unsigned> count{0};
  std::filesystem::path path = target;
  std::ostringstream suffix;
  suffix << '.' << ::getpid() << '-' << count++ << ".tmp";
  path += suffix.str();
  return path;
}

// So that a place that cannot be written is told by the system's own reason, whatever then writes.
void create_empty(const std::filesystem::path& file) {
  errno = 0;
  if (!std::ofstream(file, std::ios::binary)) {
    throw std::runtime_error(errno != 0 ? std::strerror(errno) : "it cannot be opened");
  }
}

}  // namespace

void replace_file(const std::filesystem::path& named,
                  const std::function<void(const std::filesystem::path& temporary)>& write) {
  // A link stays a link: what it points to is replaced.
  std::error_code unresolved;
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(named, unresolved);
  const std::filesystem::path target = unresolved ? named : resolved;
  const std::filesystem::path temporary = temporary_beside(target);
  try {
    // A rename would fail on a directory only after all the work, and with a less plain reason.
    if (std::filesystem::is_directory(target)) throw std::runtime_error("it is a directory");
    create_empty(temporary);
    write(temporary);
    std::filesystem::rename(temporary, target);
  } catch (const std::filesystem::filesystem_error& error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw OutputError(named.string(), "", "cannot be written: " + error.code().message());
  } catch (const std::exception& error) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw OutputError(named.string(), "", std::string("cannot be written: ") + error.what());
  }
}

void write_file(const std::filesystem::path& target, std::span<const std::byte> contents) {
  replace_file(target, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary);
    file.write(reinterpret_cast<const char*>(contents.data()), static_cast<std::streamsize>(contents.size()));
    file.close();
    if (!file) throw std::runtime_error(errno != 0 ? std::strerror(errno) : "the disk refused");
  });
}

}  // namespace render
