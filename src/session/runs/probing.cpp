#include "session/runs/probing.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace ifov::session {
namespace {

constexpr std::size_t kMostProbes = 4096;

/// Probing ends at this standard error of so many probes at least; or when there are no more.
struct Goal {
  double error;
  std::size_t probes;
};
constexpr Goal kGoal{0.06, 32}, kLateGoal{0.15, 8};
constexpr double kLeastProbing_s = 1.0, kLate_s = 60.0, kMostProbing_s = 180.0;

double seconds_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double thread_s() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

/// All pieces of a grid, each once, so that the first few are spread over it: the sequence R2 of Roberts
/// (2018), "The unreasonable effectiveness of quasirandom sequences", which is that of the plastic number,
/// then what it left out.
std::vector<int> spread_order(int columns, int rows) {
  constexpr double kX = 0.7548776662466927, kY = 0.5698402909980532;
  std::vector<bool> taken(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const std::size_t most = std::min(taken.size(), kMostProbes);
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

}  // namespace

double process_s() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

Probing::Probing(const Image& image, std::function<std::size_t()> chunks_made, render::EarlierTiles* earlier)
    : image_(image),
      chunks_made_(std::move(chunks_made)),
      earlier_(earlier),
      order_(spread_order(image.columns, image.rows)),
      setup_s_(-process_s()) {}

std::optional<int> Probing::next() {
  const std::scoped_lock lock(mutex_);
  if (setup_s_ < 0.0) setup_s_ += process_s();
  if (next_ < order_.size() && is_enough()) next_ = order_.size();
  if (next_ == order_.size()) return std::nullopt;
  begun_[std::this_thread::get_id()] = {thread_s(), 0.0};
  return order_[next_++];
}

void Probing::write(const sampling::TileResult& tile) {
  const double now_s = thread_s();
  const std::scoped_lock lock(mutex_);
  Probe probe;
  probe.pixels = tile.tile.count();
  const Begun& begun = begun_[std::this_thread::get_id()];
  probe.rays = static_cast<double>(tile.rays.total()) - begun.earlier_rays;
  probe.seconds = now_s - begun.at_s;
  probe.memory = static_cast<double>(tile.memory.size());
  double own = 0.0;
  for (const std::uint32_t samples : tile.samples) own += samples;
  const double halo = static_cast<double>(tile.halo_samples);
  probe.halo_share = own + halo > 0.0 ? halo / (own + halo) : 0.0;
  probe.chunks = static_cast<double>(chunks_made_());
  probes_.push_back(probe);
  pixels_ += probe.pixels;
}

bool Probing::read(std::size_t index, sampling::TileResult& tile) {
  if (!earlier_->read(index, tile)) return false;
  const std::scoped_lock lock(mutex_);
  begun_[std::this_thread::get_id()].earlier_rays = static_cast<double>(tile.rays.total());
  return true;
}

bool Probing::is_enough() const {
  const double time_s = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (time_s >= kMostProbing_s) return !probes_.empty();
  const Goal& goal = time_s < kLate_s ? kGoal : kLateGoal;
  return time_s >= kLeastProbing_s && probes_.size() >= goal.probes &&
         std::max(rays().error, processor_s().error) < goal.error;
}

template <class Cost>
Mean Probing::mean(const Cost& cost) const {
  double sum = 0.0, squares = 0.0;
  // What lies in the surroundings of a small piece is more than its share of a whole tile's.
  const auto of_tile = [&](const Probe& probe) {
    return cost(probe) * (1.0 - probe.halo_share + probe.halo_share * image_.surroundings);
  };
  for (const Probe& probe : probes_) sum += of_tile(probe);
  const double mean = sum / std::max(pixels_, 1.0);
  for (const Probe& probe : probes_) squares += std::pow(of_tile(probe) - mean * probe.pixels, 2);
  // What is probed is known: only the rest is uncertain.
  return {mean, std::sqrt(squares * std::max(0.0, 1.0 - share())) / std::max(sum, 1e-300)};
}

double Probing::chunks(std::size_t all) const {
  if (probes_.empty()) return 0.0;
  const double most = static_cast<double>(all), found = probes_.back().chunks,
               earlier = probes_[(probes_.size() - 1) / 2].chunks, later = found - earlier;
  const double limit = later < earlier ? earlier * earlier / (earlier - later) : later > 0.0 ? most : found;
  return found + (1.0 - share()) * (std::min(most, limit) - found);
}

Mean Probing::rays() const {
  return mean([](const Probe& probe) { return probe.rays; });
}
Mean Probing::processor_s() const {
  return mean([](const Probe& probe) { return probe.seconds; });
}
double Probing::memory_bytes_per_pixel() const {
  double sum = 0.0;
  for (const Probe& probe : probes_) sum += probe.memory;
  return sum / std::max(pixels_, 1.0);
}

}  // namespace ifov::session
