#include "session/runs/merge.h"

#include <algorithm>
#include <mutex>

#include "core/error.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/tile_index.h"
#include "io/run_state/tile_survey.h"
#include "session/runs/run_products.h"
#include "session/runs/tile_assembly.h"

namespace ifov::session {
namespace {

std::vector<io::RunPlan> plans_of(const std::vector<std::filesystem::path>& folders) {
  std::vector<io::RunPlan> plans;
  for (const auto& folder : folders) {
    std::error_code ignored;
    if (!std::filesystem::exists(io::plan_file(folder), ignored))
      throw InputError(
          format("'{}' holds no tiles of a run (run.part); expected the output folder of 'ifov render "
                 "--tiles'",
                 folder.string()));
    plans.push_back(io::read_plan(io::plan_file(folder)));
    const std::vector<std::string> lines = io::differences(plans.front(), plans.back());
    if (lines.empty()) continue;
    std::string message = format(
        "the tiles in '{}' and in '{}' are not of one run:", folders.front().string(), folder.string());
    for (const std::string& line : lines) message += format("\n  {}", line);
    throw InputError(message);
  }
  return plans;
}

/// Which folder is to have more tiles, a line each, and which share nobody has.
std::string where_tiles_are_missing(const std::vector<std::filesystem::path>& folders,
                                    const std::vector<io::RunPlan>& plans, const std::vector<bool>& done) {
  std::string text;
  std::vector<bool> owned(done.size());
  for (std::size_t f = 0; f < folders.size(); ++f) {
    std::size_t missing = 0;
    for (std::size_t k = 0; k < done.size(); ++k) {
      if (!plans[f].share.has(k)) continue;
      owned[k] = true;
      if (!done[k]) ++missing;
    }
    if (missing > 0)
      text += format("\n  {}: {} tiles of its share {}/{} are not done", folders[f].string(), missing,
                     plans[f].share.number, plans[f].share.count);
  }
  std::size_t missing = 0;
  for (std::size_t k = 0; k < done.size(); ++k) missing += !owned[k] && !done[k] ? 1 : 0;
  if (missing > 0) text += format("\n  {} tiles are in the share of none of these folders", missing);
  return text;
}

}  // namespace

RunResult merge_runs(const std::vector<std::filesystem::path>& folders, const MergeOptions& options) {
  const std::vector<io::RunPlan> plans = plans_of(folders);
  const io::RunPlan& plan = plans.front();
  const std::vector<sampling::PixelRect> grid = plan.grid();
  const auto require_all = [&](const std::vector<bool>& done) {
    const auto count = static_cast<std::size_t>(std::count(done.begin(), done.end(), true));
    if (count == done.size() || options.partial) return;
    throw InputError(
        format("{} of {} tiles are missing:{}\nFinish them with 'ifov render --tiles ... --resume', or make "
               "products with gaps (--partial).",
               done.size() - count, done.size(), where_tiles_are_missing(folders, plans, done)));
  };
  std::vector<bool> done(grid.size());
  std::vector<io::TileIndex> indices;
  Progress totals;
  for (std::size_t f = 0; f < folders.size(); ++f) {
    const io::TilesDone tiles = io::survey_tiles(folders[f], plans[f], &indices.emplace_back(plans[f]));
    for (std::size_t k = 0; k < grid.size(); ++k) done[k] = done[k] || tiles.done[k];
    totals.elapsed_s += tiles.elapsed_s;
  }
  require_all(done);

  RunProducts products(plan, options.output_folder, false);
  std::mutex mutex;
  std::vector<bool> read(grid.size());
  sampling::ReasonCounts reasons{};
  const auto take = [&](std::size_t index, sampling::TileResult& tile) {
    for (const io::TileIndex& tiles : indices) {
      if (!tiles.has(index)) continue;
      const std::string fault = tiles.read(index, {}, tile);
      const std::scoped_lock lock(mutex);
      if (!fault.empty()) {
        if (options.log != nullptr) options.log->warn(fault);
        continue;
      }
      read[index] = true;
      totals.pixels_done += tile.tile.count();
      totals.pixels_converged += tile.converged_count();
      sampling::add_reasons(tile.reasons, reasons);
      totals.rays += static_cast<std::int64_t>(tile.rays.total());
      for (const float ratio : tile.worst_ratio)
        totals.worst_error_ratio = std::max<double>(totals.worst_error_ratio, ratio);
      return true;
    }
    return false;
  };
  TileAssembly(plan, {}, take, &products).finish(done, options.threads, sampling::Reason::unjudged);
  require_all(read);  // a damaged one shows only when it is read
  totals.pixels_total = static_cast<std::int64_t>(plan.image.width_px) * plan.image.height_px;
  RunResult result;
  result.summary = products.finish(totals, reasons, options.threads, "their tiles were not there to merge");
  result.tiles_done = static_cast<std::size_t>(std::count(read.begin(), read.end(), true));
  result.tiles_left = grid.size() - result.tiles_done;
  return result;
}

}  // namespace ifov::session
