#include "session/runs/run_status.h"

#include <cmath>

#include "core/error.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_state.h"

namespace ifov::session {
namespace {

std::string duration(double seconds) {
  if (seconds < 60.0) return format("{:.1f} s", seconds);
  if (seconds < 3600.0) return format("{:.1f} min", seconds / 60.0);
  return format("{:.1f} h", seconds / 3600.0);
}

std::string line(const char* name, const std::string& value) { return format("{:<10} {}\n", name, value); }

std::string accuracy(const io::RunPlan& plan, const io::TilesDone& tiles) {
  if (!plan.judged) return format("none was asked for ({})", plan.identity.sampler);
  if (tiles.pixels == 0) return format("asked for {}; no pixel is done yet", plan.identity.accuracy_asked);
  const std::string reasons = sampling::describe_reasons(tiles.reasons);
  return format(
      "asked for {}; reached in {} of the {} pixels done{}; the widest interval is {:.2f} of its limit",
      plan.identity.accuracy_asked, tiles.converged, tiles.pixels,
      reasons.empty() ? "" : format(" (not: {})", reasons), tiles.worst_ratio);
}

RunStatus unfinished(const std::filesystem::path& folder) {
  const io::RunPlan plan = io::read_plan(io::plan_file(folder));
  const io::TilesDone tiles = io::survey_tiles(folder, plan);
  std::size_t wanted = 0;
  std::int64_t pixels = 0;
  const std::vector<sampling::PixelRect> grid = plan.grid();
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (!plan.share.has(k)) continue;
    ++wanted;
    pixels += grid[k].count();
  }
  const double done = static_cast<double>(tiles.pixels) / static_cast<double>(pixels);
  std::string text = format("{}: unfinished run of {}, ifov {}, seed {}\n", folder.string(),
                            plan.identity.document_path, plan.identity.version, plan.identity.seed);
  if (!plan.share.is_whole())
    text += line("share",
                 format("{}/{} of the image's {} tiles", plan.share.number, plan.share.count, grid.size()));
  text += line("done", format("{} of {} tiles, {:.1f} % of the pixels", tiles.count(), wanted,
                              std::floor(1000.0 * done) / 10.0));
  text += line("accuracy", accuracy(plan, tiles));
  text += line("so far", format("{} rays, {}", tiles.rays, duration(tiles.elapsed_s)));
  text += line("left", wanted == tiles.count() ? std::string("nothing but the products")
                       : tiles.pixels > 0 ? format("{} tiles, about {} at this rate", wanted - tiles.count(),
                                                   duration(tiles.elapsed_s * (1.0 - done) / done))
                                          : format("{} tiles", wanted));
  const std::string holder = io::lock_holder(io::state_folder(folder) / "lock");
  text += line("at work", holder.empty() ? "nobody; --resume goes on" : holder);
  return {.document = plan.identity.document_path,
          .version = plan.identity.version,
          .seed = plan.identity.seed,
          .share_number = plan.share.number,
          .share_count = plan.share.count,
          .tiles_done = tiles.count(),
          .tiles_wanted = wanted,
          .pixels_done = tiles.pixels,
          .pixels_wanted = pixels,
          .pixels_converged = tiles.converged,
          .rays = static_cast<std::uint64_t>(tiles.rays),
          .elapsed_s = tiles.elapsed_s,
          .worst_error_ratio = tiles.worst_ratio,
          .at_work = holder,
          .text = text};
}

}  // namespace

RunStatus status_of(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (std::filesystem::exists(io::plan_file(folder), ignored)) return unfinished(folder);
  if (!io::holds_complete_run(folder))
    throw InputError(
        format("'{}' holds no run: neither an unfinished one (run.part) nor a complete one (NAME_run.json)",
               folder.string()));
  RunStatus status;
  status.complete = true;
  status.kept = std::filesystem::exists(io::kept_folder(folder), ignored);
  status.text = format("{}: complete{}; 'ifov info {}' describes it\n", folder.string(),
                       status.kept ? ", kept for --refine" : "", folder.string());
  return status;
}

}  // namespace ifov::session
