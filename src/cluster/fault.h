#pragma once

#include <string>

#include "cluster/payload.h"

namespace ifov::cluster {

/// Why a rank cannot go on, so that the first one can say it.
struct Fault {
  enum class Kind : int { none, stopped, input, environment, bug };
  Kind kind = Kind::none;
  std::string text;

  explicit operator bool() const { return kind != Kind::none; }
};

/// The exception that is being handled.
Fault current_fault();

/// Throws InputError, SystemError, Cancelled or std::runtime_error; `rank` is named in it ("rank 3 on
/// node7").
[[noreturn]] void raise(const Fault& fault, const std::string& rank);

void put(Payload& payload, const Fault& fault);
Fault take_fault(Payload& payload);

}  // namespace ifov::cluster
