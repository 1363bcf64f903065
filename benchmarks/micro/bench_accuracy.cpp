#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/tolerance.h"

// What the accuracy sampler itself costs per ray: a tile over a field whose answers cost next to nothing,
// less the time that the field takes for as many answers.

namespace {

using namespace ifov::sampling;

/// Discs on a square grid of 2.5 px, hot on cold: one pixel in two is mixed.
class DiscGrid final : public Field {
 public:
  int columns() const override { return 1; }
  void labels(std::span<const FocalPoint> points, std::span<Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) labels[k] = label(points[k]);
    counts_.primary += points.size();
  }
  void values(std::span<const PathRequest> requests, std::span<Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      labels[k] = label(requests[k].point);
      values[k * 16] = labels[k] == 1 ? 12.1f : 8.4f;
    }
    counts_.primary += requests.size();
  }
  std::uint32_t material_of(Label label) const override { return static_cast<std::uint32_t>(label); }
  RayCounts counts() const override { return counts_; }

 private:
  static Label label(FocalPoint p) {
    const double x = p.x_px - 2.5 * std::floor(p.x_px / 2.5) - 1.25,
                 y = p.y_px - 2.5 * std::floor(p.y_px / 2.5) - 1.25;
    return x * x + y * y < 0.55 ? 1 : 2;
  }
  RayCounts counts_;
};

class Limit final : public Tolerance {
 public:
  void limits(std::span<const double>, std::span<double> limit) const override {
    std::fill(limit.begin(), limit.end(), 0.0189);
  }
  double confidence() const override { return 0.95; }
};

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

void accuracy_bookkeeping(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const PixelFootprint footprint = PixelFootprint::box(1.0);
  const Limit limit;
  const int steering_channels[1] = {0};
  TileProblem problem;
  problem.tile = problem.image = {0, 0, side, side};
  problem.footprint = &footprint;
  problem.tolerance = &limit;
  problem.steering_channels = steering_channels;
  const AccuracySampler sampler;
  TileResult result;
  double own = 0.0, rays = 0.0;
  std::vector<FocalPoint> points(4096);
  std::vector<Label> labels(points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = {std::fmod(0.618 * static_cast<double>(k), side),
                 std::fmod(0.377 * static_cast<double>(k), side)};
  for (auto _ : state) {
    DiscGrid field;
    const auto start = std::chrono::steady_clock::now();
    sampler.sample(problem, field, result);
    const auto sampled = std::chrono::steady_clock::now();
    const std::uint64_t asked = field.counts().primary;
    for (std::uint64_t done = 0; done < asked; done += points.size()) {
      field.labels(points, labels);
      benchmark::DoNotOptimize(labels.data());
    }
    const auto floor = std::chrono::steady_clock::now();
    own += seconds(sampled - start) - seconds(floor - sampled);
    rays += static_cast<double>(asked);
    state.SetIterationTime(seconds(sampled - start));
  }
  state.counters["rays_per_px"] = rays / static_cast<double>(state.iterations()) / (side * side);
  state.counters["figure"] = 1e9 * own / rays;
  state.counters["at_most"] = 30.0;
  state.SetLabel("ns per ray of bookkeeping");
}
BENCHMARK(accuracy_bookkeeping)->Arg(16)->Arg(64)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
