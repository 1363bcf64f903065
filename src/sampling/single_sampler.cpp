#include "sampling/single_sampler.h"

#include <algorithm>
#include <limits>

#include "sampling/hash.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

void SingleSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns(), false);
  const RayCounts before = field.counts();
  const int width = problem.tile.width();
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  // One point finds a feature of area a with probability a.
  constexpr float kFoundArea = 0.95f;
  result.samples.assign(result.samples.size(), 1);
  result.radiance_evaluations.assign(result.samples.size(), 1);
  result.missable_fraction.assign(result.samples.size(), kFoundArea);
  if (problem.tolerance != nullptr)
    result.worst_ratio.assign(result.samples.size(), std::numeric_limits<float>::infinity());
  result.abundances.reserve(result.samples.size());
  for_each_value(
      field, problem.cancel, static_cast<std::size_t>(problem.tile.count()),
      [&](std::size_t pixel) {
        const int i = problem.tile.x0 + static_cast<int>(pixel) % width;
        const int j = problem.tile.y0 + static_cast<int>(pixel) / width;
        return PathRequest{{i + 0.5, j + 0.5}, hash(problem.seed, i, j, kPixelPaths), 0};
      },
      [&](std::size_t pixel, Label label, const float* values) {
        std::copy(values, values + columns,
                  result.mean.begin() + static_cast<std::ptrdiff_t>(pixel * columns));
        result.abundances.push_back({static_cast<std::uint32_t>(pixel), field.material_of(label), 1.0f,
                                     std::numeric_limits<float>::quiet_NaN()});
      });
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
