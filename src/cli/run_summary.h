#pragma once

#include <cstddef>

#include "cli/exit_code.h"
#include "session/runs/run.h"

namespace ifov::cli {

/// Prints what a run made, what it cost and what accuracy it reached.
void print_summary(const session::RunResult& result);

/// What the shell is told of a run that ended by itself. `warnings`: of the scene; what is said of the machine (a lock
/// that is taken over, a cache that cannot be written) does not count.
ExitCode outcome_of(const session::RunResult& result, std::size_t warnings);

}  // namespace ifov::cli
