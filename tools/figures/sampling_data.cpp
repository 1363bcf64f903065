#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "figure_data.h"
#include "sampling/accuracy/accuracy_sampler.h"
#include "sampling/pixel_footprint.h"
#include "sampling/random_placement.h"
#include "sampling/sequence.h"
#include "sampling/tile.h"
#include "sampling/tolerance.h"

namespace ifov::figures {

namespace {

/// Ground whose radiance rises to the east (label 0), a disc (1), a roof in the corner (2) that covers part of the disc,
/// and a narrow path (3). Prints every point that is asked for.
class Picture final : public sampling::Field {
 public:
  int columns() const override { return 1; }

  void labels(std::span<const sampling::FocalPoint> points, std::span<sampling::Label> labels) override {
    for (std::size_t k = 0; k < points.size(); ++k) {
      labels[k] = label(points[k]);
      print("label", points[k], labels[k]);
    }
    ++batch_;
  }

  void values(std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const sampling::FocalPoint at = requests[k].point;
      labels[k] = label(at);
      constexpr double kRadiance[] = {6.0, 9.0, 12.0, 7.5};
      const double slope = labels[k] == 0 ? 0.4 * std::sin(2.0 * at.x_px) : 0.0;
      values[k * static_cast<std::size_t>(stride())] = static_cast<float>(kRadiance[labels[k]] + slope);
      print("value", at, labels[k]);
    }
    ++batch_;
  }

  std::uint32_t material_of(sampling::Label label) const override {
    return static_cast<std::uint32_t>(label);
  }
  sampling::RayCounts counts() const override { return {}; }

 private:
  static sampling::Label label(sampling::FocalPoint p) {
    if (p.x_px > 1.62 && p.y_px < 1.28 + 0.12 * (p.x_px - 1.62)) return 2;
    if (std::hypot(p.x_px - 1.45, p.y_px - 1.4) < 0.78) return 1;
    return std::abs(p.y_px - 2.55 + 0.17 * p.x_px) < 0.07 ? 3 : 0;
  }

  void print(const char* kind, sampling::FocalPoint at, sampling::Label label) const {
    std::printf("%s %d %.9f %.9f %d\n", kind, batch_, at.x_px, at.y_px, static_cast<int>(label));
  }

  int batch_ = 0;
};

class Relative final : public sampling::Tolerance {
 public:
  void limits(std::span<const double> mean, std::span<double> limit) const override {
    for (std::size_t c = 0; c < mean.size(); ++c) limit[c] = 0.01 * mean[c];
  }
  double confidence() const override { return 0.95; }
};

}  // namespace

void print_sampler_points() {
  Picture picture;
  const Relative tolerance;
  const sampling::PixelFootprint footprint = sampling::PixelFootprint::box(1.0);
  constexpr int kSteering[] = {0};
  sampling::TileProblem problem;
  problem.tile = problem.image = {0, 0, 3, 3};
  problem.seed = 7;
  problem.footprint = &footprint;
  problem.tolerance = &tolerance;
  problem.steering_channels = kSteering;
  sampling::TileResult result;
  sampling::AccuracySampler().sample(problem, picture, result);
  for (std::size_t k = 0; k < result.mean.size(); ++k)
    std::printf("pixel %zu %.4f %.4f %u %d\n", k, static_cast<double>(result.mean[k]),
                static_cast<double>(result.half_width[k]), result.samples[k], result.converged(k));
}

void print_sequence() {
  for (std::uint32_t k = 0; k < 64; ++k) {
    const sampling::Point2 p = sampling::sequence_point(2, k, 1);
    std::printf("point %u %.6f %.6f\n", k, p.x, p.y);
  }
}

void print_random_positions() {
  sampling::PlacementPlan plan;
  plan.minimum_distance_m = 1.0;
  plan.peak_density_m2 = sampling::largest_placement_density(1.0);
  plan.seed = 3;
  plan.area = {0.0, 0.0, 12.0, 12.0};
  for (const sampling::RandomPosition& position : sampling::random_positions(plan))
    std::printf("place %.4f %.4f\n", position.at_m.x, position.at_m.y);

  const double highest = plan.peak_density_m2;
  for (int k = 0; k <= 100; ++k) {
    const double density = highest * k / 100.0;
    std::printf("formula %.5f %.5f\n", sampling::placement_proposals(density, 1.0) * std::numbers::pi / 4.0,
                density * std::numbers::pi / 4.0);
  }
  plan.area = {0.0, 0.0, 300.0, 300.0};
  for (const double share : {0.1, 0.25, 0.4, 0.55, 0.7, 0.8, 0.9, 1.0}) {
    plan.peak_density_m2 = share * highest;
    const auto count = static_cast<double>(sampling::random_positions(plan).size());
    std::printf("measured %.5f %.5f\n",
                sampling::placement_proposals(plan.peak_density_m2, 1.0) * std::numbers::pi / 4.0,
                count / plan.area.square_metres() * std::numbers::pi / 4.0);
  }
}

}  // namespace ifov::figures
