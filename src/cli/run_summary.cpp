#include "cli/run_summary.h"

#include <algorithm>

#include "cli/terminal/progress_line.h"
#include "cli/terminal/say.h"
#include "core/format.h"

namespace ifov::cli {

void print_summary(const Outcome& outcome) {
  std::string text;
  for (const Product& file : outcome.products) text += format("{}  ({})\n", file.path.string(), file.what);
  const Progress& totals = outcome.totals;
  text += format(
      "{} pixels, {} rays in {} ({} rays/s)\n", totals.pixels_done,
      short_count(static_cast<double>(totals.rays)),
      totals.elapsed_s < 60.0 ? format("{:.2f} s", totals.elapsed_s) : short_duration(totals.elapsed_s),
      short_count(static_cast<double>(totals.rays) / std::max(totals.elapsed_s, 1e-9)));
  if (!outcome.accuracy_statement.empty()) text += outcome.accuracy_statement + "\n";
  if (outcome.tiles_left > 0)
    text += format("Stopped by the time limit: {} of {} tiles are done. --resume goes on.\n",
                   outcome.tiles_done, outcome.tiles_done + outcome.tiles_left);
  else if (outcome.products.empty())
    text += format(
        "All {} tiles of this share are done and kept in {}; 'ifov merge' makes the products of all "
        "shares.\n",
        outcome.tiles_done, outcome.folder.string());
  say(text);
}

void print_summary(const SeriesOutcome& outcome) {
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

void print_summary(const InstrumentsOutcome& outcome) {
  for (const InstrumentsOutcome::One& one : outcome.instruments) {
    say(format("{}:\n", one.name));
    print_summary(one.outcome);
  }
  if (outcome.left > 0) say(format("Stopped by the time limit: {} instruments are left.\n", outcome.left));
}

}  // namespace ifov::cli
