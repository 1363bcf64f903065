#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "ifov/api.h"

namespace ifov {

/// Where a value stands in a text file. Lines and columns count from 1; 0 means "the file as a whole".
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

/// The user's input is wrong: what() is the whole message as shown to the user (position, what was found, what
/// was expected, the choices, an excerpt with a caret where there is one).
class IFOV_API InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message, SourcePosition position = {})
      : std::runtime_error(message), position_(std::move(position)) {}
  const SourcePosition& position() const { return position_; }

 private:
  SourcePosition position_;
};

/// What the system lacks or refuses: a missing or unwritable file, a full disk, memory that cannot be had.
class IFOV_API SystemError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run was stopped on request (Ctrl-C, a cancelled token).
class IFOV_API Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped on request") {}
};

}  // namespace ifov
