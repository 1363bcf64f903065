#pragma once

namespace ifov::cli {

/// What the program returns to the shell; documented in docs/guide/command_line.md and in --help.
enum class ExitCode : int {
  ok = 0,
  input = 1,        ///< the command line, a document or a file that it names is wrong
  environment = 2,  ///< a file cannot be read or written, the disk is full, memory ran out
  bug = 3,          ///< the program is at fault
  unmet = 4,        ///< a study ran, and a figure is not what it must be
  unconverged = 5,  ///< done, and some pixels do not meet the accuracy
  warned = 6,       ///< done, and something was warned of
  stopped = 130,    ///< Ctrl-C
};

}  // namespace ifov::cli
