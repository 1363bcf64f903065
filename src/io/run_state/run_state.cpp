#include "io/run_state/run_state.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>

#include "core/error.h"
#include "io/files/own_files.h"
#include "io/products/part_file.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/tile_packs.h"
#include "sampling/tile_arrays.h"

namespace ifov::io {
namespace {

/// Adds up tiles, each once, and the time of the starts they come from.
class Survey {
 public:
  explicit Survey(std::size_t tiles) { result_.done.resize(tiles); }

  /// False for a tile that is there already.
  bool add(const TileHeader& header) {
    double& elapsed_s = elapsed_[header.start];
    elapsed_s = std::max(elapsed_s, header.elapsed_s);
    if (result_.done[header.index]) return false;
    result_.done[header.index] = true;
    result_.pixels += header.rect().count();
    result_.converged += header.converged;
    for (std::size_t r = 0; r < result_.reasons.size(); ++r) result_.reasons[r] += header.reasons[r];
    result_.rays +=
        static_cast<std::int64_t>(header.primary_rays + header.shadow_rays + header.continuation_rays);
    result_.worst_ratio = std::max<double>(result_.worst_ratio, header.worst_ratio);
    return true;
  }
  TilesDone result() {
    result_.elapsed_s = 0.0;
    for (const auto& [start, elapsed_s] : elapsed_) result_.elapsed_s += elapsed_s;
    return result_;
  }

 private:
  TilesDone result_;
  std::map<std::uint64_t, double> elapsed_;
};

void remove_leftovers(const std::filesystem::path& tiles) {
  std::error_code error;
  std::vector<std::filesystem::path> leftovers;
  for (std::filesystem::directory_iterator entry(tiles, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".part") leftovers.push_back(entry->path());
  for (const auto& leftover : leftovers) std::filesystem::remove(leftover, error);
}

std::string tile_count(const TilesDone& tiles) {
  return format("{} of {} tiles", tiles.count(), tiles.done.size());
}

void require_same(const std::filesystem::path& folder, const RunPlan& was, const RunPlan& is) {
  std::vector<std::string> lines = differences(was, is);
  if (was.share != is.share)
    lines.push_back(format("the share of the tiles was {}/{} and is {}/{}", was.share.number, was.share.count,
                           is.share.number, is.share.count));
  if (lines.empty()) return;
  std::string message =
      format("{}: the run cannot go on, because its tiles would not fit together:", folder.string());
  for (const std::string& line : lines) message += format("\n  {}", line);
  throw InputError(message +
                   format("\nPut back what has changed and resume; or keep the {} that are done and render "
                          "into another folder (--output); or throw them away and start anew (--restart).",
                          tile_count(survey_tiles(folder, was))));
}

}  // namespace

std::size_t TilesDone::count() const {
  return static_cast<std::size_t>(std::count(done.begin(), done.end(), true));
}

TilesDone survey_tiles(const std::filesystem::path& folder, const RunPlan& plan, TileIndex* index) {
  Survey survey(plan.grid().size());
  TileIndex own(plan);
  for (const auto& pack : packs_in(state_folder(folder) / "tiles"))
    (index != nullptr ? index : &own)->add(pack, [&](const TileHeader& header) { survey.add(header); });
  return survey.result();
}

bool holds_complete_run(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().ends_with("_run.json")) return true;
  return false;
}

ProductBytes product_bytes(const RunPlan& plan) {
  ProductBytes bytes;
  for (const Quantity* quantity : plan.made_cubes()) {
    const std::uint64_t cube = cube_size(*quantity, plan.image).bytes();
    (cube >= kManyBytes ? bytes.direct : bytes.cached) += cube;
  }
  bytes.cached += plan.formats.bytes(plan.image, plan.made_cubes());
  return bytes;
}

std::uint64_t leftover_bytes(const std::filesystem::path& folder) {
  constexpr std::uint64_t kBlock = 512;  // of st_blocks, whatever the file system's own
  std::uint64_t bytes = 0;
  const auto add = [&](const std::filesystem::path& place, const std::string& ending) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(place, error), end; !error && entry != end;
         entry.increment(error)) {
      struct stat info {};
      if (entry->path().extension() == ending && stat(entry->path().c_str(), &info) == 0 &&
          S_ISREG(info.st_mode))
        bytes += kBlock * static_cast<std::uint64_t>(info.st_blocks);
    }
  };
  add(folder, ".part");
  add(state_folder(folder) / "tiles", ".part");
  add(state_folder(folder) / "tiles", kPackEnding);
  return bytes;
}

std::uint64_t state_bytes(const RunPlan& plan, bool one_process) {
  constexpr std::uint64_t kMaterialsInPixel = 2;
  // Measured: values are out when the cubes have a line of tiles; what is left shrinks to a third, more where cameras tilt.
  constexpr double kTilesHigh = 1.5, kPacked = 0.5;
  const auto width = static_cast<std::uint64_t>(plan.image.width_px),
             height = static_cast<std::uint64_t>(plan.image.height_px);
  std::uint64_t values = 0, others = kMaterialsInPixel * sizeof(sampling::Abundance);
  const sampling::TileResult pixel = plan.example_tile(1);
  sampling::TileResult::visit_arrays(pixel, [&](const sampling::TileArray& array, const auto& elements) {
    (array.in_cubes ? values : others) += sizeof(elements[0]) * elements.size();
  });
  for (const sampling::TileLayer& layer : pixel.layers) others += layer.bytes.size();
  const bool leaves = one_process && plan.share.is_whole() && plan.leaves_values_to_cubes();
  const std::uint64_t held =
      leaves ? std::min(height, static_cast<std::uint64_t>(kTilesHigh * plan.tile_px)) : height;
  const std::uint64_t kept =
      leaves ? static_cast<std::uint64_t>(kPacked * static_cast<double>(others)) : others;
  return width * (height * kept + held * values) / static_cast<std::uint64_t>(plan.share.count) +
         plan.grid().size() * frame_bytes(pixel);
}

RunState::RunState(const std::filesystem::path& folder, const RunPlan& plan, RunStart start, LogSink* log)
    : plan_(plan), log_(log), path_(state_folder(folder)), index_(plan) {
  require_space(folder, 0);
  refuse_link(path_);
  require_space(path_, 0);
  lock_ = std::make_unique<RunLock>(path_ / "lock", log);
  const std::filesystem::path kept_plan = plan_file(folder), tiles = path_ / "tiles";
  const bool exists = std::filesystem::exists(kept_plan);
  if (exists && start == RunStart::fresh) {
    const TilesDone kept = survey_tiles(folder, read_plan(kept_plan));
    if (kept.count() > 0)
      throw InputError(
          format("{}: this folder holds an unfinished run, {} are done. Go on with it (--resume), throw it "
                 "away and start anew (--restart), or take another folder (--output).",
                 folder.string(), tile_count(kept)));
  }
  if (exists && start == RunStart::resume) {
    plan_ = read_plan(kept_plan);
    require_same(folder, plan_, plan);
  } else {
    std::error_code ignored;
    std::filesystem::remove_all(tiles, ignored);
    PartFile file(kept_plan);
    write_part(file, to_json(plan_));
    file.publish();
    sync_folder(path_);
  }
  refuse_link(tiles);
  remove_leftovers(tiles);
}

TilesDone RunState::read(const std::function<void(const sampling::TileResult&)>& take) {
  const std::vector<sampling::PixelRect> grid = plan_.grid();
  const TileDemands demands{plan_.key(), static_cast<int>(plan_.image.channels.size()), grid};
  Survey survey(grid.size());
  for (const auto& pack : packs_in(path_ / "tiles")) {
    HeldPack held{pack, 0};
    read_pack(
        pack, demands, cubes_.read_values,
        [&](const TileHeader& header, const sampling::TileResult& tile) {
          if (survey.add(header)) take(tile);
          if (header.values_in_cubes == 0) held.line_end = std::max(held.line_end, tile.tile.y1);
        },
        log_, true);
    if (held.line_end > 0) held_.push_back(std::move(held));
  }
  index_ = TileIndex(plan_);  // of what is whole
  for (const auto& pack : packs_in(path_ / "tiles")) index_.add(pack);
  store_ = std::make_unique<TileStore>(path_ / "tiles", plan_.key());
  if (cubes_.lines_written && plan_.leaves_values_to_cubes())
    store_->when_written(
        [this](const std::filesystem::path& pack, int line_end) { move_values_out(pack, line_end); });
  return survey.result();
}

void RunState::move_values_out(const std::filesystem::path& pack, int line_end) {
  held_.push_back({pack, line_end});
  const int lines = cubes_.lines_written();
  const std::vector<sampling::PixelRect> grid = plan_.grid();
  const TileDemands demands{plan_.key(), static_cast<int>(plan_.image.channels.size()), grid};
  std::erase_if(held_, [&](const HeldPack& held) {
    if (held.line_end > lines) return false;
    try {
      io::move_values_out(held.path, demands);
      return true;
    } catch (const SystemError&) {
      return false;  // it stays as it was, and is tried again
    }
  });
}

TilesDone RunState::find(int rank, int packs) {
  Survey survey(plan_.grid().size());
  // By their names: on network file systems a list of the folder may be out of date.
  for (int k = 0; k < packs; ++k)
    index_.add(path_ / "tiles" / pack_name(store_start(), rank, store_start().first_pack + k),
               [&](const TileHeader& header) { survey.add(header); });
  return survey.result();
}

bool RunState::read_tile(std::size_t index, sampling::TileResult& tile) const {
  const std::string fault = index_.read(index, cubes_.read_values, tile);
  if (!fault.empty() && log_ != nullptr) log_->warn(fault);
  return fault.empty();
}

void RunState::put(std::uint32_t index, const sampling::TileResult& tile) { store_->put(index, tile); }

int RunState::close() {
  if (!store_) return 0;
  store_->close();
  return store_->packs();
}

void RunState::keep() {
  store_.reset();
  const std::filesystem::path kept = kept_folder(path_.parent_path());
  std::error_code error;
  std::filesystem::remove_all(kept, error);
  if (!error) std::filesystem::rename(path_, kept, error);
  if (error)
    throw SystemError(
        format("{}: the finished tiles cannot be kept here: {}", kept.string(), error.message()));
  std::filesystem::remove(kept / "lock", error);
  lock_.reset();
}

void RunState::remove() {
  store_.reset();
  std::error_code ignored;
  // First, so that nobody who looks on takes a run that is done for one that loses its tiles.
  std::filesystem::remove(plan_file(path_.parent_path()), ignored);
  std::filesystem::remove_all(kept_folder(path_.parent_path()), ignored);
  std::filesystem::remove_all(path_ / "tiles", ignored);
  lock_.reset();
  std::filesystem::remove(path_, ignored);
}

}  // namespace ifov::io
