// What every writer of files throws when the disk refuses: a failure at run time, not bad input.
#pragma once

#include <stdexcept>
#include <string>

namespace render {

class OutputError : public std::runtime_error {
 public:
  OutputError(std::string file, std::string field, std::string reason)
      : std::runtime_error(field.empty() ? file + ": " + reason : file + ": " + field + ": " + reason),
        file_(std::move(file)),
        field_(std::move(field)),
        reason_(std::move(reason)) {}

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& field() const { return field_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string file_, field_, reason_;
};

}  // namespace render
