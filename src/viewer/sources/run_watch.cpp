#include "viewer/sources/run_watch.h"

#include "core/error.h"
#include "io/files/own_files.h"
#include "io/product_parts/cube_tile.h"
#include "io/run_state/run_folder.h"
#include "io/run_state/run_plan.h"
#include "io/run_state/tile_index.h"
#include "io/run_state/tile_survey.h"

namespace ifov::viewer {

RunWatch::RunWatch(const std::filesystem::path& folder)
    : folder_(folder),
      status_(run_status(folder)),
      plan_(std::make_unique<const io::RunPlan>(io::read_plan(io::plan_file(folder)))),
      grid_(plan_->grid()) {
  auto index = std::make_unique<io::TileIndex>(*plan_);
  done_ = io::survey_tiles(folder, *plan_, index.get()).done;
  index_ = std::move(index);
}

RunWatch::~RunWatch() = default;

int RunWatch::channels() const { return static_cast<int>(plan_->image.channels.size()); }

bool RunWatch::read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const {
  const int bands = static_cast<int>(plan_->image.channels.size());
  const auto fill = [&](const char* quantity, const char* ending, std::vector<float>& values) {
    if (values.empty()) return true;
    const io::OwnFile file(folder_ / (plan_->name + "_" + quantity + ".img" + ending));
    if (!file) return false;
    io::read_cube_tile(
        [&](std::uint64_t offset, void* to, std::size_t bytes) { file.read_at(offset, to, bytes); },
        {io::interleave_named(plan_->interleave), plan_->image.width_px, plan_->image.height_px, bands},
        tile.tile, values);
    return true;
  };
  // The cubes get their own names when the run ends, which may be at any time.
  for (const char* const ending : {".part", ""}) {
    try {
      if (fill("radiance", ending, tile.mean) && fill("half_width", ending, tile.half_width) && is_right())
        return true;
    } catch (const SystemError&) {
      // What cannot be read is not there.
    }
  }
  return false;
}

RunWatch::Tile RunWatch::tile(std::size_t index, std::size_t channel) const {
  sampling::TileResult result;
  const std::string fault = index_->read(
      index,
      [this](sampling::TileResult& tile, const std::function<bool()>& is_right) {
        return read_values(tile, is_right);
      },
      result);
  if (!fault.empty()) throw SystemError(fault);
  const auto columns = static_cast<std::size_t>(result.columns);
  Tile tile{{}, result.worst_ratio};
  for (std::size_t at = channel; at < result.mean.size(); at += columns) tile.mean.push_back(result.mean[at]);
  return tile;
}

void request_stop(const std::filesystem::path& folder) {
  io::write_new_file(io::stop_file(folder), "stop\n");
}

bool holds_unfinished_run(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(io::plan_file(folder), ignored);
}

}  // namespace ifov::viewer
