// What every reader of user input throws: the file (or option), the field as a dotted path, and what is wrong and
// allowed. It lives in the vocabulary folder because every other folder may include it; only main catches it.
#pragma once

#include <stdexcept>
#include <string>

namespace tracking {

class InputError : public std::runtime_error {
 public:
  InputError(std::string file, std::string field, std::string reason)
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

}  // namespace tracking
