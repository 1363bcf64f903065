#include "session/facade/run_outcome.h"

#include <new>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace ifov {
namespace session {

Verdict verdict_of(const RunResult& result, std::size_t warnings) {
  if (result.tiles_left > 0) return Verdict::time_limit;
  const Progress& totals = result.summary.totals;
  if (result.summary.judged && totals.pixels_converged < totals.pixels_done) return Verdict::unconverged;
  return warnings > 0 || result.summary.one_value ? Verdict::warned : Verdict::done;
}

Outcome outcome_of(RunResult result, const std::vector<std::string>& warnings) {
  Outcome outcome;
  outcome.verdict = verdict_of(result, warnings.size());
  outcome.folder = std::move(result.summary.folder);
  for (ProductFile& file : result.summary.files)
    outcome.products.push_back({std::move(file.path), std::move(file.what)});
  outcome.totals = result.summary.totals;
  outcome.accuracy_statement = std::move(result.summary.accuracy_statement);
  outcome.warnings = warnings;
  outcome.tiles_done = result.tiles_done;
  outcome.tiles_left = result.tiles_left;
  return outcome;
}

}  // namespace session

int exit_code_of(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return 1;
  if (dynamic_cast<const Cancelled*>(&error) != nullptr) return 130;
  const bool surroundings = dynamic_cast<const SystemError*>(&error) != nullptr ||
                            dynamic_cast<const std::system_error*>(&error) != nullptr ||
                            dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  return surroundings ? 2 : 3;
}

}  // namespace ifov
