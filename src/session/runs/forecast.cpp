#include "session/runs/forecast.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/machine_memory.h"
#include "core/parallel.h"
#include "geometry/world.h"
#include "io/products/part_file.h"
#include "io/run_state/kept_run.h"
#include "io/run_state/run_state.h"
#include "render/image_renderer.h"
#include "render/tile_grid.h"
#include "sampling/pixel_sampler.h"
#include "session/loaded/parts.h"
#include "session/runs/coordinator.h"
#include "session/runs/plan_assembly.h"
#include "session/runs/probing.h"
#include "session/runs/refinement.h"
#include "session/runs/resource_check.h"
#include "session/session.h"

namespace ifov::session {
namespace {

/// Pieces are at least this wide: on smaller ones what a tile does beyond its rim would weigh too much.
constexpr int kLeastPiece_px = 8, kLeastPieceWithWideMargin_px = 16;
constexpr double kWideMargin_px = 2.0;
constexpr int kWantedPieces = 256;

/// Pieces are not tiles, and no two runs take the same time: the standard error is at least this.
constexpr double kLeastError = 0.05;

/// Processor time of writing products, and for each byte of them, of tiles, and of what goes through the page cache; and
/// what publishing takes. Measured on a virtual machine's disk.
constexpr double kProducts_s = 0.05, kProduct_s_per_byte = 1.4e-9, kTile_s_per_byte = 0.7e-9,
                 kCached_s_per_byte = 2.2e-9;
constexpr double kPublishing_s = 0.15, kPublishing_bytes_per_s = 250e6;

/// Share of a square's surroundings within `margin` in square and surroundings together.
double surroundings(double side, double margin) {
  const double outer = side + 2.0 * margin;
  return (outer * outer - side * side) / (side * side);
}

int pieces_across(int pixels, int piece_px) { return (pixels + piece_px - 1) / piece_px; }

io::RunPlan plan_of(const Parts& parts, const RunRequest& request, const std::filesystem::path& folder) {
  io::RunPlan plan = assemble_plan(parts);
  plan.share = request.share;
  if (request.keep_finished) require_refinable(parts);
  plan.keeps_memory = request.keep_finished;
  if (request.refine) plan_refinement(folder, parts, plan);
  return plan;
}

/// What pieces took while they were at work, for tiles that are, with their margins, so many times as wide: between as much,
/// where the most expensive piece of a tile makes it, and as many times as much as pieces fit into a tile, where all are alike.
std::uint64_t work_of_tiles(std::uint64_t piece_bytes, double width_ratio) {
  return static_cast<std::uint64_t>(std::max(1.0, width_ratio) * static_cast<double>(piece_bytes));
}

/// Of trees that rays of the run will need and those of the probe did not.
std::uint64_t unmade_chunk_bytes(const geometry::World::Storage& storage, const Probing& probing) {
  if (storage.chunks_made == 0) return 0;
  const double made = static_cast<double>(storage.chunks_made),
               bytes = static_cast<double>(storage.chunk_bytes);
  return static_cast<std::uint64_t>(bytes / made * std::max(0.0, probing.chunks(storage.chunks) - made));
}

}  // namespace

Forecast forecast_run(const Session& session, const RunRequest& request) {
  const Parts& parts = session.parts();
  const RunOptions& options = request.options;
  const std::filesystem::path folder = request.folder(session);
  const io::RunPlan plan = plan_of(parts, request, folder);
  const int width = plan.image.width_px, height = plan.image.height_px;
  const double area = static_cast<double>(width) * height;
  const int own_threads = request.coordinator != nullptr ? request.coordinator->threads(options.threads)
                          : options.threads > 0          ? options.threads
                                                         : usual_threads();

  const geometry::World& world = *parts.scene.world;

  Forecast forecast;
  const io::ProductBytes products = plan.share.is_whole() ? io::product_bytes(plan) : io::ProductBytes{};
  const std::uint64_t tile_bytes =
      request.keep_tiles ? io::state_bytes(plan, request.coordinator == nullptr) : 0;
  forecast.product_bytes = products.all();
  forecast.disk_bytes = forecast.product_bytes + tile_bytes;
  forecast.memory_bytes = least_memory_bytes(plan, own_threads);
  forecast.shortages = shortages(folder, 0, forecast.memory_bytes);
  if (!forecast.shortages.empty()) {  // a probe might not end
    forecast.shortages = shortages(folder, forecast.disk_bytes, forecast.memory_bytes);
    return forecast;
  }

  render::RenderJob job = parts.job();
  set_contents(plan, job);
  const std::unique_ptr<io::KeptTiles> earlier = open_kept(folder, plan, options.log);
  const int wanted = static_cast<int>(std::sqrt(area / kWantedPieces));
  const double margin_px = job.sampler.halo_px() + job.reach_px();
  const int least = margin_px > kWideMargin_px ? kLeastPieceWithWideMargin_px : kLeastPiece_px;
  // Tiles that are refined are as large as they were.
  job.tile_px = earlier ? plan.tile_px : std::min(plan.tile_px, std::max(wanted, least));
  Probing probing(
      {.columns = pieces_across(width, job.tile_px),
       .rows = render::tile_rows(plan.image.height_px, job.tile_px, plan.image.sweep_lines),
       .pixels = area,
       .surroundings = surroundings(plan.tile_px, margin_px) / surroundings(job.tile_px, margin_px)},
      [&world] { return world.storage().chunks_made; }, earlier.get());
  if (earlier) job.earlier = &probing;
  render::RenderControl control;
  control.threads = own_threads;
  control.cancel = options.cancel;
  control.source = &probing;
  const auto begin = std::chrono::steady_clock::now();
  const std::uint64_t loaded_bytes = peak_memory_bytes();
  render::render_image(job, control, probing);

  // Trees that the probe made stay; they are not the work of pieces.
  const std::uint64_t grown_bytes = peak_memory_bytes() - loaded_bytes,
                      trees_bytes = std::min<std::uint64_t>(grown_bytes, world.storage().chunk_bytes);
  const double share = 1.0 / plan.share.count;
  const Mean rays = probing.rays(), seconds = probing.processor_s();
  forecast.rays = share * area * rays.value;
  forecast.uncertainty = std::hypot(kLeastError, std::max(rays.error, seconds.error));
  forecast.probes = probing.count();
  forecast.probed_share = probing.share();
  forecast.probing_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (request.keep_tiles)
    forecast.disk_bytes += static_cast<std::uint64_t>(share * area * probing.memory_bytes_per_pixel());
  forecast.memory_bytes = std::max(
      forecast.memory_bytes,
      loaded_bytes + trees_bytes +
          work_of_tiles(grown_bytes - trees_bytes,
                        (plan.tile_px + 2.0 * margin_px) / (job.tile_px + 2.0 * margin_px)) +
          unmade_chunk_bytes(world.storage(), probing) + (plan.share.is_whole() ? buffer_bytes(plan) : 0));
  forecast.shortages = shortages(folder, forecast.disk_bytes, forecast.memory_bytes);

  const double tracing_s = share * area * seconds.value,
               writing_s = kProduct_s_per_byte * static_cast<double>(products.all()) +
                           kTile_s_per_byte * static_cast<double>(tile_bytes) +
                           kCached_s_per_byte *
                               static_cast<double>(products.cached + std::min(tile_bytes, io::kManyBytes));
  forecast.processor_s = probing.setup_s() + tracing_s + writing_s + kProducts_s;
  // No more threads have work than there are tiles, and the last ones to have some wait for the rest.
  const double threads = request.coordinator != nullptr ? request.coordinator->all_threads()
                                                        : std::min(own_threads, usual_threads());
  const double tiles =
      std::ceil(share * pieces_across(width, plan.tile_px) *
                render::tile_rows(plan.image.height_px, plan.tile_px, plan.image.sweep_lines));
  const double rounds = std::ceil(tiles / threads);
  forecast.elapsed_s = probing.setup_s() + (tracing_s + writing_s) * rounds / tiles + kPublishing_s +
                       static_cast<double>(products.cached) / kPublishing_bytes_per_s;
  return forecast;
}

}  // namespace ifov::session
