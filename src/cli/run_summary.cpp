#include "cli/run_summary.h"

#include <algorithm>

#include "cli/terminal/progress_line.h"
#include "cli/terminal/say.h"
#include "core/format.h"
#include "session/facade/run_outcome.h"

namespace ifov::cli {

void print_summary(const session::RunResult& result) {
  const session::RunSummary& summary = result.summary;
  std::string text;
  for (const session::ProductFile& file : summary.files)
    text += format("{}  ({})\n", file.path.string(), file.what);
  const Progress& totals = summary.totals;
  text += format(
      "{} pixels, {} rays in {} ({} rays/s)\n", totals.pixels_done,
      short_count(static_cast<double>(totals.rays)),
      totals.elapsed_s < 60.0 ? format("{:.2f} s", totals.elapsed_s) : short_duration(totals.elapsed_s),
      short_count(static_cast<double>(totals.rays) / std::max(totals.elapsed_s, 1e-9)));
  if (!summary.accuracy_statement.empty()) text += summary.accuracy_statement + "\n";
  if (result.tiles_left > 0)
    text += format("Stopped by the time limit: {} of {} tiles are done. --resume goes on.\n",
                   result.tiles_done, result.tiles_done + result.tiles_left);
  else if (summary.files.empty())
    text += format(
        "All {} tiles of this share are done and kept in {}; 'ifov merge' makes the products of all "
        "shares.\n",
        result.tiles_done, summary.folder.string());
  say(text);
}

ExitCode outcome_of(const session::RunResult& result, std::size_t warnings) {
  return static_cast<ExitCode>(session::verdict_of(result, warnings));
}

}  // namespace ifov::cli
