#include "session/forecast.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>

#include "core/machine_memory.h"
#include "io/run_state/run_state.h"
#include "session/parts.h"
#include "session/needs.h"
#include "session/plan_assembly.h"

namespace ifov::session {
namespace {

using Clock = std::chrono::steady_clock;

/// Pieces are at least this wide: on smaller ones what a tile does beyond its rim would weigh too much.
constexpr int kLeastPiece_px = 16;
constexpr int kWantedPieces = 256;
/// Probing ends at this standard error, after this time, or when all pieces are probed.
constexpr std::size_t kLeastProbes = 32;
constexpr double kWantedError = 0.06, kMostProbing_s = 60.0, kLeastProbing_s = 1.0;

/// What a piece took.
struct Probe {
  double pixels = 0.0, rays = 0.0, seconds = 0.0;
  double halo_share = 0.0;  ///< of its samples
};

/// Takes the time between the tiles of each thread.
class ProbeSink final : public render::TileSink {
 public:
  ProbeSink() { start(); }
  void begin(const render::ImageInfo&) override {}
  /// All threads begin their next tile now.
  void start() {
    last_.clear();
    begin_ = Clock::now();
  }
  void write(const sampling::TileResult& tile) override {
    const std::scoped_lock lock(mutex_);
    const Clock::time_point now = Clock::now();
    Clock::time_point& last = last_.try_emplace(std::this_thread::get_id(), begin_).first->second;
    Probe probe;
    probe.pixels = tile.tile.count();
    probe.rays = static_cast<double>(tile.rays.total());
    probe.seconds = std::chrono::duration<double>(now - last).count();
    double own = 0.0;
    for (const std::uint32_t samples : tile.samples) own += samples;
    const double halo = static_cast<double>(tile.halo_samples);
    probe.halo_share = own + halo > 0.0 ? halo / (own + halo) : 0.0;
    probes.push_back(probe);
    last = now;
  }
  std::vector<Probe> probes;

 private:
  std::mutex mutex_;
  Clock::time_point begin_;
  std::map<std::thread::id, Clock::time_point> last_;
};

/// All pieces of a grid, each once, so that the first few are spread over it: the sequence R2 of Roberts
/// (2018), "The unreasonable effectiveness of quasirandom sequences", which is that of the plastic number,
/// then what it left out.
std::vector<int> spread_order(int columns, int rows, std::size_t most) {
  constexpr double kX = 0.7548776662466927, kY = 0.5698402909980532;
  std::vector<bool> taken(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<int> order;
  const auto take = [&](std::size_t piece) {
    if (taken[piece] || order.size() >= most) return;
    taken[piece] = true;
    order.push_back(static_cast<int>(piece));
  };
  for (std::size_t k = 0; k < 4 * most; ++k) {
    const double x = std::fmod(0.5 + kX * static_cast<double>(k), 1.0),
                 y = std::fmod(0.5 + kY * static_cast<double>(k), 1.0);
    take(static_cast<std::size_t>(y * rows) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(x * columns));
  }
  for (std::size_t piece = 0; piece < taken.size(); ++piece) take(piece);
  return order;
}

/// Share of a square's surroundings within `margin` in square and surroundings together.
double surroundings(double side, double margin) {
  const double outer = side + 2.0 * margin;
  return (outer * outer - side * side) / (side * side);
}

struct Mean {
  double value = 0.0, error = 0.0;  ///< relative standard error
};

/// Mean of a cost per pixel over the probes.
template <class Cost>
Mean mean_cost(const std::vector<Probe>& probes, const Cost& cost) {
  double sum = 0.0, squares = 0.0, pixels = 0.0;
  for (const Probe& probe : probes) {
    sum += cost(probe);
    pixels += probe.pixels;
  }
  const double mean = sum / pixels;
  for (const Probe& probe : probes) squares += std::pow(cost(probe) - mean * probe.pixels, 2);
  return {mean, std::sqrt(squares) / std::max(sum, 1e-300)};
}

}  // namespace

Forecast forecast_run(const Session& session, const RunRequest& request) {
  const Session::Parts& parts = session.parts();
  const RunOptions& options = request.options;
  const std::filesystem::path folder = request.folder(session);
  io::RunPlan plan = assemble_plan(parts);
  plan.share = request.share;
  const int width = plan.image.width_px, height = plan.image.height_px;
  const double area = static_cast<double>(width) * height;

  render::RenderJob job = parts.job();
  const int wanted = static_cast<int>(std::sqrt(area / kWantedPieces));
  job.tile_px = std::min(plan.tile_px, std::max(wanted, kLeastPiece_px));
  const int columns = (width + job.tile_px - 1) / job.tile_px,
            rows = (height + job.tile_px - 1) / job.tile_px;
  const std::size_t pieces = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  const std::vector<int> order = spread_order(columns, rows, std::min<std::size_t>(pieces, 4096));

  const std::size_t threads = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                                  : std::max(1u, std::thread::hardware_concurrency());
  ProbeSink sink;
  const double margin_px = job.sampler.halo_px() + job.footprint.half_width_px();
  const double scale = surroundings(plan.tile_px, margin_px) / surroundings(job.tile_px, margin_px);
  // What lies in the halo of a small piece is more than its share of a whole tile's.
  const auto of_tile = [&](const Probe& probe, double cost) {
    return cost * (1.0 - probe.halo_share + probe.halo_share * scale);
  };
  const auto rays_of = [&](const Probe& probe) { return of_tile(probe, probe.rays); };
  const auto seconds_of = [&](const Probe& probe) { return of_tile(probe, probe.seconds); };

  Forecast forecast;
  const Clock::time_point begin = Clock::now();
  Mean rays, seconds;
  for (std::size_t next = 0; next < order.size();) {
    const std::size_t count = std::min(order.size() - next, std::max(std::size_t{4} * threads, kLeastProbes));
    render::RenderControl control;
    control.threads = options.threads;
    control.cancel = options.cancel;
    control.tile_order = std::span(order).subspan(next, count);
    sink.start();
    render::render_image(job, control, sink);
    next += count;
    rays = mean_cost(sink.probes, rays_of);
    seconds = mean_cost(sink.probes, seconds_of);
    forecast.probing_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const bool sure =
        std::max(rays.error, seconds.error) < kWantedError && forecast.probing_s >= kLeastProbing_s;
    if (sure || forecast.probing_s >= kMostProbing_s) break;
  }
  const double share = 1.0 / plan.share.count;
  forecast.rays = share * area * rays.value;
  forecast.elapsed_s = share * area * seconds.value / static_cast<double>(threads);
  forecast.uncertainty = std::max(rays.error, seconds.error);
  forecast.probes = sink.probes.size();
  for (const Probe& probe : sink.probes) forecast.probed_share += probe.pixels / area;
  forecast.product_bytes = plan.share.is_whole() ? io::product_bytes(plan) : 0;
  forecast.disk_bytes = forecast.product_bytes + (request.keep_tiles ? io::state_bytes(plan) : 0);
  forecast.memory_bytes = peak_memory_bytes() + (plan.share.is_whole() ? buffer_bytes(plan) : 0);
  forecast.shortages = shortages(folder, forecast.disk_bytes, forecast.memory_bytes);
  return forecast;
}

}  // namespace ifov::session
