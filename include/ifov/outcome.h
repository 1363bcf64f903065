#pragma once

#include <cstddef>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "ifov/api.h"
#include "ifov/run_control.h"

namespace ifov {

/// How a run ended that ended by itself. Values are the exit codes of the program (docs/guide/command_line.md).
enum class Verdict {
  done = 0,         ///< and all is well
  time_limit = 4,   ///< the deadline came before all was done
  unconverged = 5,  ///< done, and some pixels do not meet the accuracy
  warned = 6,       ///< done, and something was warned of
};

struct Product {
  std::filesystem::path path;
  std::string what;  ///< one line for people: "radiance, 210 channels, ENVI"
};

struct Outcome {
  Verdict verdict = Verdict::done;
  std::filesystem::path folder;       ///< of the products; empty where tiles stayed in memory
  std::vector<Product> products;      ///< likewise
  Progress totals;                    ///< of all starts of the run: pixels done and converged, rays, time
  std::string accuracy_statement;     ///< plain words: what was asked for, what was reached, where it was not
  std::vector<std::string> warnings;  ///< of loading
  std::size_t tiles_done = 0, tiles_left = 0;

  int exit_code() const { return static_cast<int>(verdict); }
  /// Every pixel is done and meets the accuracy, where one was asked for.
  bool converged() const { return verdict == Verdict::done || verdict == Verdict::warned; }
};

/// What the program would return for an exception of this library: 1 for InputError, 2 for SystemError and where the
/// system or memory fails, 130 for Cancelled, 3 (a bug) for all others.
IFOV_API int exit_code_of(const std::exception& error);

}  // namespace ifov
