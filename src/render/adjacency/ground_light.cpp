#include "render/adjacency/ground_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/parallel.h"
#include "geometry/world.h"
#include "radiometry/spectral_nodes.h"
#include "sampling/random.h"
#include "scene/scene.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

constexpr std::size_t kLeastCellsAcross = 64, kMostCellsAcross = 256;
constexpr double kFineCell_m = 100.0;     ///< cells need not be smaller for more of them
constexpr double kCoarseReach_m = 150e3;  ///< of the coarsest raster
constexpr std::size_t kMostLevels = 26, kDenseLevels = 3;
constexpr std::size_t kCellSide = 2;  ///< rays along each side of a cell of the finest rasters
constexpr double kBlackBody_k = 300.0, kHottestGround_k = 350.0;

}  // namespace

GroundLight::GroundLight(const transport::SpectralScene& scene, const transport::AdjacentGround::Area& area,
                         int threads)
    : x_m_(0.5 * (area.west_m + area.east_m)), y_m_(0.5 * (area.south_m + area.north_m)) {
  const double side_m = std::max({area.east_m - area.west_m, area.north_m - area.south_m, 1e-3});
  across_ = kLeastCellsAcross;
  while (across_ < kMostCellsAcross && side_m / static_cast<double>(across_) > kFineCell_m) across_ *= 2;
  cell_m_ = side_m / static_cast<double>(across_ - 4);
  double reach_m = 0.5 * cell_m_ * static_cast<double>(across_);
  for (levels_ = 1; levels_ < kMostLevels && reach_m < kCoarseReach_m; ++levels_) reach_m *= 2.0;

  const radiometry::SpectralNodes& nodes = scene.nodes();
  const double sine = scene.scene().sun ? std::max(0.0, scene.scene().sun->direction.z) : 0.0;
  node_brightness_.resize(nodes.node_count());
  nodes.planck(kBlackBody_k, std::span<double>(node_brightness_));
  for (std::size_t n = 0; n < node_brightness_.size(); ++n)
    node_brightness_[n] += static_cast<double>(scene.sun_irradiance()[n]) * sine / std::numbers::pi +
                           static_cast<double>(scene.sky_radiance()[n]);
  brightness_.assign(nodes.channel_count(), 0.0);
  for (std::size_t c = 0; c < brightness_.size(); ++c)
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      brightness_[c] += nodes.node_weight(n) * node_brightness_[n];

  beyond_.resize(levels_ * across_ * across_, nodes.channel_count());
  skylit_.resize(beyond_.rows(), nodes.channel_count());
  parallel_for(static_cast<std::int64_t>(levels_ * across_), threads, [&](std::int64_t k) {
    look_down(scene, static_cast<std::size_t>(k) / across_, static_cast<std::size_t>(k) % across_);
  });
  for (std::size_t level = 1; level < levels_; ++level) take_means(level);
  for (std::size_t c = 0; c < channels(); ++c) {
    float low = 0.0f, high = 0.0f;
    for (std::size_t k = 0; k < beyond_.rows(); ++k)
      low = std::min(low, beyond_.row(k)[c]), high = std::max(high, beyond_.row(k)[c]);
    contrast_.push_back(static_cast<double>(high - low));
  }
}

bool GroundLight::inner(std::size_t level, std::size_t column, std::size_t row) const {
  const auto within = [&](std::size_t k) { return k >= across_ / 4 && k < across_ - across_ / 4; };
  return level > 0 && within(column) && within(row);
}

void GroundLight::look_down(const transport::SpectralScene& scene, std::size_t level, std::size_t row) {
  const scene::Scene& all = scene.scene();
  const geometry::World& world = *all.world;
  const radiometry::SpectralNodes& nodes = scene.nodes();
  const double cell_m = std::ldexp(cell_m_, static_cast<int>(level)),
               half = 0.5 * static_cast<double>(across_);
  const double above_m = world.heights().high_m + 1.0;
  const std::size_t side = level < kDenseLevels ? kCellSide : 1;
  std::vector<math::Ray> down, up;
  std::vector<std::size_t> cells;
  for (std::size_t column = 0; column < across_; ++column) {
    if (inner(level, column, row)) continue;
    for (std::size_t k = 0; k < side * side; ++k) {
      const std::uint64_t key = sampling::hash(level, row, column, k);
      const double u = (static_cast<double>(k % side) + sampling::unit_double(key)) /
                       static_cast<double>(side),
                   v = (static_cast<double>(k / side) + sampling::unit_double(key + 1)) /
                       static_cast<double>(side);
      down.push_back({{x_m_ + (static_cast<double>(column) + u - half) * cell_m,
                       y_m_ + (static_cast<double>(row) + v - half) * cell_m, above_m},
                      {0.0, 0.0, -1.0}});
      cells.push_back(index(level, column, row));
    }
  }
  std::vector<geometry::SurfacePoint> hits(down.size());
  world.intersect(down, hits);
  const std::optional<scene::Sun>& sun = all.sun;
  std::vector<std::uint8_t> blocked(down.size(), 1);
  if (sun && sun->direction.z > 0.0) {
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const math::Vec3 outward = hits[k].geometric_normal.as_vector();
      up.push_back(
          hits[k].hit()
              ? down[k].onward(hits[k].position_m + hits[k].offset_m * (outward.z < 0.0 ? -outward : outward),
                               sun->direction)
              : math::Ray{{0.0, 0.0, above_m + 1.0}, {0.0, 0.0, 1.0}});
    }
    world.occluded(up, blocked);
  }
  const std::size_t stride = scene.stride();
  radiometry::SpectrumBlock work(7, scene.node_count());
  float *emitted_work = work.row(0), *sun_work = work.row(3), *share_work = work.row(4),
        *reflected = work.row(5), *hot = work.row(6);
  nodes.planck(kHottestGround_k, work.values(6));
  const float* around = scene.surroundings_radiance();
  const double weight = 1.0 / static_cast<double>(side * side);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].hit()) continue;  // the ground all around
    const scene::ResolvedSurface surface = all.resolve(hits[k]);
    std::fill_n(reflected, stride, 0.0f);
    for (const scene::Constituent& part : surface) {
      const float* own = scene.materials().reflectance(part.material);
      for (std::size_t n = 0; n < stride; ++n) reflected[n] += static_cast<float>(part.weight) * own[n];
    }
    const float* emission = scene.emission(surface, {0.0, 0.0, 1.0}, emitted_work);
    math::Vec3 normal = surface.shading_normal.as_vector();
    if (normal.z < 0.0) normal = -normal;
    const double height_m = hits[k].position_m.z;
    const float* sunlight = scene.sun_irradiance(height_m, sun_work);
    const float* share = scene.light_by_height() ? scene.sky_share(height_m, share_work) : nullptr;
    const float direct =
        sun && blocked[k] == 0
            ? static_cast<float>(std::max(0.0, dot(normal, sun->direction)) / std::numbers::pi)
            : 0.0f;
    const float open = static_cast<float>(0.5 * (1.0 + normal.z));
    for (std::size_t c = 0; c < channels(); ++c) {
      double light = 0.0, of_sky = 0.0;
      for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n) {
        const float sky =
            reflected[n] * open * scene.sky_radiance()[n] * (share != nullptr ? share[n] : 1.0f);
        const float sent = reflected[n] * (sunlight[n] * direct + (1.0f - open) * around[n]) + sky +
                           (emission != nullptr ? std::min(emission[n], hot[n]) : 0.0f);
        light += nodes.node_weight(n) * static_cast<double>(sent - around[n]);
        of_sky += nodes.node_weight(n) * static_cast<double>(sky);
      }
      if (!(brightness_[c] > 0.0)) continue;
      beyond_.row(cells[k])[c] += static_cast<float>(weight * light / brightness_[c]);
      skylit_.row(cells[k])[c] += static_cast<float>(weight * of_sky / brightness_[c]);
    }
  }
}

void GroundLight::take_means(std::size_t level) {
  const std::size_t quarter = across_ / 4;
  for (std::size_t row = quarter; row < across_ - quarter; ++row)
    for (std::size_t column = quarter; column < across_ - quarter; ++column)
      for (radiometry::SpectrumBlock* block : {&beyond_, &skylit_}) {
        float* mean = block->row(index(level, column, row));
        for (std::size_t k = 0; k < 4; ++k) {
          const float* fine =
              block->row(index(level - 1, 2 * (column - quarter) + k % 2, 2 * (row - quarter) + k / 2));
          for (std::size_t c = 0; c < channels(); ++c) mean[c] += 0.25f * fine[c];
        }
      }
}

GroundLight::Corners GroundLight::at(double x_m, double y_m, double cell_m, std::size_t finest) const {
  const double half = 0.5 * static_cast<double>(across_);
  const double farthest = std::max(std::abs(x_m - x_m_), std::abs(y_m - y_m_));
  std::size_t level = finest;
  double side = std::ldexp(cell_m_, static_cast<int>(finest));
  while (level < levels_ && (1.5 * side < cell_m || farthest >= (half - 1.0) * side)) ++level, side *= 2.0;
  if (level >= levels_) {
    level = levels_ - 1, side = std::ldexp(cell_m_, static_cast<int>(level));
    if (farthest >= (half - 1.0) * side) return {};
  }
  const double x = (x_m - x_m_) / side + half - 0.5, y = (y_m - y_m_) / side + half - 0.5;
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const float u = static_cast<float>(x - static_cast<double>(column)),
              v = static_cast<float>(y - static_cast<double>(row));
  Corners corners;
  corners.any = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t cell = index(level, column + k % 2, row + k / 2);
    corners.beyond[k] = beyond_.row(cell), corners.skylit[k] = skylit_.row(cell);
    corners.weight[k] = (k % 2 == 1 ? u : 1.0f - u) * (k / 2 == 1 ? v : 1.0f - v);
  }
  return corners;
}

}  // namespace ifov::render
