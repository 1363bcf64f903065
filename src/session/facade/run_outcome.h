#pragma once

#include <cstddef>

#include "ifov/outcome.h"
#include "session/runs/run.h"

namespace ifov::session {

/// What is said of a run that ended by itself. `warnings`: of the scene; what is said of the machine (a lock that is taken
/// over, a cache that cannot be written) does not count.
Verdict verdict_of(const RunResult& result, std::size_t warnings);

Outcome outcome_of(RunResult result, const std::vector<std::string>& warnings);

}  // namespace ifov::session
