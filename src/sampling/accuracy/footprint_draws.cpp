#include "sampling/accuracy/footprint_draws.h"

#include <cmath>
#include <stdexcept>

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/basis/ray_ledger.h"
#include "sampling/accuracy/basis/stopping.h"
#include "sampling/accuracy/source_grid.h"
#include "sampling/footprint_groups.h"
#include "sampling/hash.h"
#include "sampling/pixel_limits.h"
#include "sampling/sequence.h"
#include "sampling/sub_element_lattice.h"
#include "sampling/tile.h"

namespace ifov::sampling {

namespace {

constexpr int kReplicates = 8;
constexpr std::uint32_t kFirstNet = 4;

}  // namespace

void draw_from_footprint(const TileProblem& problem, Field& field, std::uint32_t most_samples,
                         TileResult& result) {
  if (problem.groups != nullptr)
    throw std::invalid_argument("rays are drawn from one footprint, not from several groups of channels");
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  const std::size_t stride = static_cast<std::size_t>(field.stride());
  result.reset(problem.tile, field.columns());
  const Lattice lattice(source_domain(problem, ColumnFootprints(*problem.footprint).reach(), 0), 1);
  LabelTable table(field.columns());
  RayLedger ledger(field, problem.cancel, lattice, table, nullptr);
  PixelLimits limits(*problem.tolerance, problem.later);
  const Stopping stopping(problem.tolerance->confidence());
  const std::size_t pixels = static_cast<std::size_t>(problem.tile.count());

  std::vector<double> sums(pixels * kReplicates * columns, 0.0), mean(columns), limit(columns), half(columns);
  std::vector<std::size_t> open(pixels);
  for (std::size_t p = 0; p < pixels; ++p) open[p] = p;
  std::uint32_t done = 0, net = kFirstNet;
  for (int test = 0; test < Stopping::kTests && !open.empty(); ++test) {
    std::vector<PathRequest> requests;
    for (std::size_t p : open) {
      const int x = problem.tile.x0 + static_cast<int>(p) % problem.tile.width();
      const int y = problem.tile.y0 + static_cast<int>(p) / problem.tile.width();
      for (int r = 0; r < kReplicates; ++r) {
        const std::uint64_t key = hash(problem.seed, 0x64726177, x, y, r);
        for (std::uint32_t i = done; i < net; ++i) {
          const Point2 d = footprint_point(*problem.footprint, sequence_point(key, i, 0));
          requests.push_back({{x + 0.5 + d.x, y + 0.5 + d.y}, mix(key), i});
        }
      }
    }
    std::vector<std::uint32_t> labels;
    std::vector<float> values(requests.size() * stride);
    ledger.values(requests, labels, values);
    const std::size_t per_net = net - done;
    for (std::size_t k = 0; k < requests.size(); ++k) {
      const std::size_t p = open[k / (kReplicates * per_net)], r = k / per_net % kReplicates;
      for (std::size_t c = 0; c < columns; ++c)
        sums[(p * kReplicates + r) * columns + c] += values[k * stride + c];
    }
    std::vector<std::size_t> wide;
    for (std::size_t p : open) {
      double worst = 0.0;
      std::vector<double> variance(columns);
      for (std::size_t c = 0; c < columns; ++c) {
        double sum = 0.0, squares = 0.0;
        for (std::size_t r = 0; r < kReplicates; ++r) {
          const double v = sums[(p * kReplicates + r) * columns + c] / net;
          sum += v;
          squares += v * v;
        }
        mean[c] = sum / kReplicates;
        variance[c] =
            std::max(0.0, squares - kReplicates * mean[c] * mean[c]) / (kReplicates * (kReplicates - 1.0));
        half[c] = stopping.student(test, kReplicates - 1.0) * std::sqrt(variance[c]);
      }
      limits.of(p, mean, limit);
      for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t i = p * columns + c;
        worst = std::max(worst, half[c] / limit[c]);
        result.mean[i] = static_cast<float>(mean[c]);
        result.variance_path[i] = static_cast<float>(variance[c]);
        result.half_width[i] = static_cast<float>(half[c]);
      }
      result.worst_ratio[p] = static_cast<float>(worst);
      result.reasons[p] = worst <= 1.0 ? 0 : bit(Reason::samples);
      result.missable_fraction[p] = static_cast<float>(0.95 / (kReplicates * net));
      result.radiance_evaluations[p] = result.samples[p] = kReplicates * net;
      if (worst > 1.0 && 2u * kReplicates * net <= most_samples) wide.push_back(p);
    }
    open.swap(wide);
    done = net;
    net *= 2;
  }
  result.rays = field.counts();
}

}  // namespace ifov::sampling
