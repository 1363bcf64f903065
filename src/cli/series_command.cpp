#include "cli/series_command.h"

#include <algorithm>

#include "cli/terminal/console.h"
#include "cli/terminal/progress_line.h"
#include "cli/terminal/say.h"
#include "core/error.h"
#include "core/format.h"

namespace ifov::cli {
namespace {

void print_series(const SeriesOutcome& outcome) {
  std::string text;
  const auto there = static_cast<std::size_t>(std::count_if(outcome.times.begin(), outcome.times.end(),
                                                            [](const auto& one) { return one.was_there; }));
  const auto whole =
      static_cast<std::size_t>(std::count_if(outcome.times.begin(), outcome.times.end(),
                                             [](const auto& one) { return one.outcome.tiles_left == 0; }));
  for (const Product& file : outcome.products) text += format("{}  ({})\n", file.path.string(), file.what);
  text += format("{}: {} times, each in a folder of its own{}\n", outcome.folder.string(), whole,
                 there > 0 ? format(" ({} of them were there already)", there) : "");
  const Progress& totals = outcome.totals;
  text += format(
      "{} pixels, {} rays in {}\n", totals.pixels_done, short_count(static_cast<double>(totals.rays)),
      totals.elapsed_s < 60.0 ? format("{:.2f} s", totals.elapsed_s) : short_duration(totals.elapsed_s));
  const auto not_met =
      static_cast<std::size_t>(std::count_if(outcome.times.begin(), outcome.times.end(), [](const auto& one) {
        return one.outcome.verdict == Verdict::unconverged;
      }));
  if (not_met > 0) text += format("At {} of the times some pixels do not meet the accuracy.\n", not_met);
  if (outcome.times_left > 0)
    text += format("Stopped by the time limit: {} times are left. --resume goes on.\n", outcome.times_left);
  say(text);
}

}  // namespace

void require_no_time(const std::vector<std::string>& set) {
  for (const std::string& one : set)
    if (one.starts_with("time="))
      throw InputError(format("--set {}: --times gives the document its times; leave one of them out", one));
}

ExitCode render_times(const Document& document, const std::string& times, const SeriesOptions& options,
                      Console& console, bool quiet) {
  const SeriesOutcome outcome = render_series(document, times, options);
  console.finish();
  if (!quiet) print_series(outcome);
  return static_cast<ExitCode>(outcome.verdict);
}

}  // namespace ifov::cli
