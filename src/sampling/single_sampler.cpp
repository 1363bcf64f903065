#include "sampling/single_sampler.h"

#include <limits>

#include "sampling/hash.h"
#include "sampling/pixel_writer.h"
#include "sampling/value_batch.h"

namespace ifov::sampling {

void SingleSampler::sample(const TileProblem& problem, Field& field, TileResult& result) const {
  result.reset(problem.tile, field.columns());
  const RayCounts before = field.counts();
  const int width = problem.tile.width();
  const std::size_t columns = static_cast<std::size_t>(field.columns());
  PixelEstimate estimate;
  estimate.variance_geometry.assign(columns, std::numeric_limits<double>::quiet_NaN());
  estimate.variance_path.assign(columns, std::numeric_limits<double>::quiet_NaN());
  for_each_value(
      field, problem.cancel, static_cast<std::size_t>(problem.tile.count()),
      [&](std::size_t pixel) {
        const int i = problem.tile.x0 + static_cast<int>(pixel) % width;
        const int j = problem.tile.y0 + static_cast<int>(pixel) / width;
        return PathRequest{{i + 0.5, j + 0.5}, hash(problem.seed, i, j, kPixelPaths), 0};
      },
      [&](std::size_t pixel, Label label, const float* values) {
        estimate.mean.assign(values, values + columns);
        estimate.materials = {{field.material_of(label), {1.0, std::numeric_limits<double>::quiet_NaN()}}};
        result.samples[pixel] = result.radiance_evaluations[pixel] = 1;
        write_pixel(estimate, problem, pixel, result);
      });
  result.rays = rays_since(before, field);
}

}  // namespace ifov::sampling
