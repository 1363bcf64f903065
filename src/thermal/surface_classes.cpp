#include "thermal/surface_classes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "thermal/linear_kernel.h"
#include "thermal/solid.h"

namespace ifov::thermal {
namespace {

constexpr int kTilts = 12, kAzimuths = 12;  // steps of half and of a whole turn
constexpr double kLeastRise_k = 0.1;        // of a surface that the Sun warms

math::Vec3 sun_of(const Outdoors& now) {
  const double level = std::cos(now.sun_elevation_rad);
  return {level * std::sin(now.sun_azimuth_rad), level * std::cos(now.sun_azimuth_rad),
          std::sin(now.sun_elevation_rad)};
}

math::Vec3 facing(double tilt_rad, double azimuth_rad) {
  return {std::sin(tilt_rad) * std::sin(azimuth_rad), std::sin(tilt_rad) * std::cos(azimuth_rad),
          std::cos(tilt_rad)};
}

/// By row of the series. The parts of the first step go to the rows beside them.
std::vector<double> kernel_by_row(const SurfaceSolution& solution) {
  const std::vector<SurfaceNode>& nodes = solution.history.nodes;
  const std::vector<double> by_node = linear_kernel(solution.cells, solution.history, nodes.size() - 1);
  std::vector<double> by_row(solution.rows, 0.0);
  const std::size_t first = solution.node_of_row(1);
  const double step_s = nodes[first].time_s - nodes[0].time_s;
  for (std::size_t i = 0; i < first; ++i) {
    const double share = (nodes[i].time_s - nodes[0].time_s) / step_s;
    by_row[0] += (1.0 - share) * by_node[i];
    by_row[1] += share * by_node[i];
  }
  for (std::size_t row = 1; row < solution.rows; ++row) by_row[row] += by_node[solution.node_of_row(row)];
  return by_row;
}

}  // namespace

SurfaceClasses::SurfaceClasses(const OutdoorsSeries& series, const ClassSurface& surface, int threads)
    : step_s_(series.step_s) {
  const std::size_t count = series.rows.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Outdoors& now = series.rows[i];
    if (!(now.direct_w_m2 > 0.0) || !(now.sun_elevation_rad > 0.0)) continue;
    rows_.push_back({i, sun_of(now), sun_of(series.rows[i > 0 ? i - 1 : 0]),
                     sun_of(series.rows[std::min(i + 1, count - 1)]),
                     surface.skin.solar_absorptance * now.direct_w_m2});
  }
  nodes_.resize(2 + (kTilts - 1) * kAzimuths);
  parallel_for(static_cast<std::int64_t>(nodes_.size()), threads, [&](std::int64_t index) {
    const int ring = static_cast<int>(index) - 2;
    const double tilt = index == 0   ? 0.0
                        : index == 1 ? std::numbers::pi
                                     : (1 + ring / kAzimuths) * kTiltStep_rad;
    solve(nodes_[static_cast<std::size_t>(index)], tilt, ring > 0 ? ring % kAzimuths * kAzimuthStep_rad : 0.0,
          series, surface);
  });
  constexpr double kBetween =
      0.05;  // of the largest rise: directions between those of the grid may face the Sun better
  coldest_k_ = hottest_k_ = nodes_[0].shaded_k[0];
  double most_k = 0.0;
  for (const Node& node : nodes_)
    for (std::size_t sky = 0; sky < 2; ++sky) {
      coldest_k_ = std::min(coldest_k_, node.shaded_k[sky]);
      hottest_k_ = std::max(hottest_k_, node.shaded_k[sky] + node.rise_k[sky]);
      most_k = std::max(most_k, node.rise_k[sky]);
    }
  hottest_k_ += kBetween * most_k;
}

void SurfaceClasses::solve(Node& node, double tilt_rad, double azimuth_rad, const OutdoorsSeries& series,
                           const ClassSurface& surface) {
  Stand stand = surface.stand;
  stand.tilt_rad = tilt_rad;
  stand.azimuth_rad = azimuth_rad;
  const math::Vec3 normal = facing(tilt_rad, azimuth_rad);
  std::vector<double> kernel(series.rows.size(), 0.0), difference = kernel;
  for (std::size_t sky = 0; sky < 2; ++sky) {
    stand.free_sky = static_cast<double>(sky);
    for (const double visibility : {0.0, 1.0}) {
      const SurfaceSolution solution =
          solve_surface(surface.solid, surface.skin, stand, series, surface.start,
                        std::vector<double>(series.rows.size(), visibility));
      const double surface_k = solution.history.nodes.back().surface_k;
      (visibility > 0.0 ? node.rise_k[sky] : node.shaded_k[sky]) = surface_k;
      const std::vector<double> one = kernel_by_row(solution);
      for (std::size_t i = 0; i < one.size(); ++i) {
        kernel[i] += 0.25 * one[i];
        difference[i] += (visibility - 0.5) * one[i];
      }
    }
    node.rise_k[sky] -= node.shaded_k[sky];
  }
  double sum_k = 0.0;
  for (const Row& row : rows_) {
    node.kernel.push_back(static_cast<float>(std::max(0.0, kernel[row.index])));
    node.difference.push_back(static_cast<float>(difference[row.index]));
    sum_k += static_cast<double>(node.kernel.back()) * row.absorbed_w_m2 *
             std::max(0.0, math::dot(normal, row.sun));
  }
  for (std::size_t sky = 0; sky < 2; ++sky)
    node.ratio[sky] = sum_k > kLeastRise_k ? node.rise_k[sky] / sum_k : 1.0;
}

math::Vec3 SurfaceClasses::sun_at(std::size_t row, double steps) const {
  const Row& of = rows_[row];
  const math::Vec3& other = steps < 0.0 ? of.before : of.after;
  const math::Vec3 between = (1.0 - std::abs(steps)) * of.sun + std::abs(steps) * other;
  return math::normalized(between);
}

std::array<SurfaceClasses::Corner, 4> SurfaceClasses::corners(math::Vec3 normal) const {
  const double tilt = std::acos(std::clamp(normal.z, -1.0, 1.0)) / kTiltStep_rad;
  const int low = std::clamp(static_cast<int>(tilt), 0, kTilts - 1);
  const double high_share = std::clamp(tilt - low, 0.0, 1.0);
  double turn = std::atan2(normal.x, normal.y) / kAzimuthStep_rad;
  if (turn < 0.0) turn += kAzimuths;
  const int west = std::clamp(static_cast<int>(turn), 0, kAzimuths - 1);
  const double east_share = std::clamp(turn - west, 0.0, 1.0);
  const auto node = [&](int ring, int azimuth) {
    if (ring == 0) return &nodes_[0];
    if (ring == kTilts) return &nodes_[1];
    return &nodes_[static_cast<std::size_t>(2 + (ring - 1) * kAzimuths + azimuth % kAzimuths)];
  };
  return {{{node(low, west), (1.0 - high_share) * (1.0 - east_share)},
           {node(low, west + 1), (1.0 - high_share) * east_share},
           {node(low + 1, west), high_share * (1.0 - east_share)},
           {node(low + 1, west + 1), high_share * east_share}}};
}

void SurfaceClasses::bends(math::Vec3 normal, std::span<const std::size_t> rows,
                           std::span<double> bend) const {
  const std::array<Corner, 4> all = corners(normal);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double kernel = 0.0, difference = 0.0;
    for (const Corner& corner : all) {
      kernel += corner.share * static_cast<double>(corner.node->kernel[rows[k]]);
      difference += corner.share * static_cast<double>(corner.node->difference[rows[k]]);
    }
    bend[k] = kernel > 0.0 ? std::clamp(difference / kernel, -1.0, 1.0) : 0.0;
  }
}

double SurfaceClasses::shaded_k(math::Vec3 normal, double free_sky) const {
  double shaded_k = 0.0;
  for (const Corner& corner : corners(normal))
    shaded_k += corner.share * std::lerp(corner.node->shaded_k[0], corner.node->shaded_k[1], free_sky);
  return shaded_k;
}

double SurfaceClasses::shaded_k(math::Vec3 normal, double free_sky, std::span<double> weight_k) const {
  std::fill(weight_k.begin(), weight_k.end(), 0.0);
  for (const Corner& corner : corners(normal)) {
    if (!(corner.share > 0.0)) continue;
    const Node& node = *corner.node;
    const double factor = corner.share * std::lerp(node.ratio[0], node.ratio[1], free_sky);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      weight_k[k] += factor * static_cast<double>(node.kernel[k]);
  }
  for (std::size_t k = 0; k < rows_.size(); ++k)
    weight_k[k] *= rows_[k].absorbed_w_m2 * std::max(0.0, math::dot(normal, rows_[k].sun));
  return shaded_k(normal, free_sky);
}

}  // namespace ifov::thermal
