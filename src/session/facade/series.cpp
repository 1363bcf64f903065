#include "ifov/series.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "session/facade/access.h"
#include "session/facade/run_outcome.h"
#include "session/series/series_record.h"
#include "session/series/series_run.h"

namespace ifov {
namespace {

/// What only a run alone takes.
void require_whole_runs(const SeriesOptions& options) {
  if (options.load.ranks != nullptr || options.render.ranks != nullptr)
    throw InputError("--times: a series is rendered by one process; start it without mpirun");
  if (options.render.share.count != 1) throw InputError("--times: a series has no shares of tiles (--tiles)");
  if (options.render.keep || options.render.refine)
    throw InputError("--times: a series keeps nothing to refine (--keep, --refine)");
  if (options.render.threads < 0 || options.load.threads < 0)
    throw InputError("threads: a negative number was asked for; 0 takes all cores");
  if (!options.render.keep_tiles && options.render.start != RunStart::fresh)
    throw InputError("keep_tiles: without finished tiles there is nothing to resume or restart");
}

/// How grave it is that a run ended so: 4, 5, 6, then 0.
std::size_t rank_of(Verdict verdict) {
  constexpr std::array kGravestFirst{Verdict::time_limit, Verdict::unconverged, Verdict::warned,
                                     Verdict::done};
  return static_cast<std::size_t>(std::find(kGravestFirst.begin(), kGravestFirst.end(), verdict) -
                                  kGravestFirst.begin());
}

}  // namespace

SeriesOutcome render_series(const Document& document, const std::string& times,
                            const SeriesOptions& options) {
  require_whole_runs(options);
  session::SeriesRequest request{session::SeriesTimes::read(times),
                                 FacadeAccess::at_times(document),
                                 FacadeAccess::inputs(document),
                                 {},
                                 {},
                                 options.strict};
  request.load = {.scene_cache = options.load.scene_cache,
                  .threads = options.load.threads,
                  .cancel = options.load.cancel};
  request.run.options = {.threads = options.render.threads,
                         .output_folder = options.render.folder,
                         .cancel = options.render.cancel,
                         .progress = options.render.progress,
                         .log = options.render.log};
  request.run.start = options.render.start;
  request.run.keep_tiles = options.render.keep_tiles;
  request.run.anyway = options.render.anyway;
  request.run.deadline = options.render.deadline;
  session::SeriesResult result = session::render_series(request);

  SeriesOutcome outcome;
  outcome.folder = std::move(result.folder);
  outcome.times_left = result.times_left;
  outcome.totals = result.totals;
  outcome.warnings = std::move(result.warnings);
  if (outcome.times_left > 0) outcome.verdict = Verdict::time_limit;
  for (session::ProductFile& file : result.files)
    outcome.products.push_back({std::move(file.path), std::move(file.what)});
  for (session::SeriesResult::OfTime& one : result.times) {
    // Which warnings they were is told once, for all times.
    Outcome of_time = session::outcome_of(std::move(one.run), std::vector<std::string>(one.warnings));
    of_time.warnings.clear();
    if (rank_of(of_time.verdict) < rank_of(outcome.verdict)) outcome.verdict = of_time.verdict;
    outcome.times.push_back({std::move(one.time), std::move(one.folder), one.was_there, std::move(of_time)});
  }
  return outcome;
}

std::optional<SeriesInfo> series_info(const std::filesystem::path& folder) {
  const std::optional<session::SeriesRecord> record = session::SeriesRecord::in(folder);
  if (!record) return std::nullopt;
  SeriesInfo info{.folder = folder,
                  .version = record->version,
                  .document = record->document,
                  .name = record->name,
                  .times = {},
                  .complete = record->complete,
                  .files = record->files};
  for (const session::SeriesRecord::One& one : record->times) {
    const std::filesystem::path at = folder / one.folder;
    info.times.push_back({one.time, at, session::complete_run(at, record->name).value_or("")});
  }
  return info;
}

}  // namespace ifov
