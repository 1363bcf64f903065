#include "render/adjacency/adjacency.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "atmosphere/sensor/channel_spread.h"
#include "core/parallel.h"
#include "geometry/world.h"
#include "radiometry/spectral_nodes.h"
#include "render/adjacency/ground_light.h"
#include "scene/scene.h"
#include "sensor/camera.h"
#include "transport/spectral_scene.h"

namespace ifov::render {
namespace {

using atmosphere::GroundSpread;
using transport::AdjacentGround;

constexpr int kSightsAcross = 24;            // rays along each side of the image
constexpr double kBeyondImage_px = 4.0;      // of what samplers look at beyond it
constexpr double kFarthestGround_m = 100e3;  // from the middle of the image: beyond, the rim holds
constexpr double kSameGround = 1e-6;         // of a white surface: as if there were no difference
constexpr double kConfident = 2.0;           // standard deviations
constexpr std::size_t kErrorChecks = 12;     // along each side, between places of the grid

/// Where the image's rays meet the ground, as a rectangle.
std::optional<AdjacentGround::Area> seen_area(const geometry::World& world, const sensor::Camera& camera) {
  std::vector<sampling::FocalPoint> points =
      sensor::grid_over(camera, kSightsAcross, kSightsAcross, kBeyondImage_px);
  points.push_back({0.5 * camera.width_px(), 0.5 * camera.height_px()});
  std::vector<math::Ray> rays(points.size());
  camera.rays(points, rays);
  std::vector<geometry::SurfacePoint> hits(rays.size());
  world.intersect(rays, hits);
  std::vector<math::Point3> seen;
  for (std::size_t k = rays.size(); k-- > 0;) {
    const math::Ray& ray = rays[k];
    if (hits[k].hit())
      seen.push_back(hits[k].position_m);
    else if (ray.direction.z < 0.0 && ray.origin_m.z > 0.0)
      seen.push_back(ray.origin_m + (-ray.origin_m.z / ray.direction.z) * ray.direction);
  }
  if (seen.empty()) return std::nullopt;
  const math::Point3 middle = seen.front();
  AdjacentGround::Area area{middle.x, middle.y, middle.x, middle.y};
  for (const math::Point3& point : seen) {
    const double x = std::clamp(point.x, middle.x - kFarthestGround_m, middle.x + kFarthestGround_m),
                 y = std::clamp(point.y, middle.y - kFarthestGround_m, middle.y + kFarthestGround_m);
    area.west_m = std::min(area.west_m, x), area.east_m = std::max(area.east_m, x);
    area.south_m = std::min(area.south_m, y), area.north_m = std::max(area.north_m, y);
  }
  const double more_m = 0.05 * std::max(area.east_m - area.west_m, area.north_m - area.south_m) + 0.01;
  return AdjacentGround::Area{area.west_m - more_m, area.south_m - more_m, area.east_m + more_m,
                              area.north_m + more_m};
}

/// Where a place looks for the ground about it: two distances for each ring and sector, with the channels' shares.
class Surrounding {
 public:
  Surrounding(const std::vector<atmosphere::ChannelSpread>& spreads, double azimuth_rad, double least_m,
              double farthest_m)
      : channels_(spreads.size()) {
    const auto& edges = GroundSpread::inner_edges_km();
    for (std::size_t ring = 0; ring < GroundSpread::kRings; ++ring) {
      const double from_m = 1e3 * edges[ring];
      if (from_m > farthest_m) break;
      const double to_m = ring + 1 < GroundSpread::kRings ? 1e3 * edges[ring + 1] : 1.35 * from_m;
      const bool near = to_m <= least_m;  // within a cell: all sectors and distances are as the middle
      for (std::size_t sector = 0; sector < (near ? 1 : GroundSpread::kSectors); ++sector)
        for (const double part : {0.25, 0.75}) {
          if (near && part > 0.5) continue;
          const double distance_m = near        ? 0.0
                                    : ring == 0 ? part * to_m
                                                : from_m * std::pow(to_m / from_m, part);
          const double angle_rad = azimuth_rad + 2.0 * std::numbers::pi * static_cast<double>(sector) /
                                                     static_cast<double>(GroundSpread::kSectors);
          places_.push_back(
              {distance_m * std::cos(angle_rad), distance_m * std::sin(angle_rad), 0.25 * distance_m});
          for (const bool up : {true, false})
            for (const atmosphere::ChannelSpread& spread : spreads) {
              const std::span<const double> shares =
                  (up ? spread.up : spread.down)
                      .shares()
                      .subspan(ring * GroundSpread::kSectors, GroundSpread::kSectors);
              double share = 0.5 * shares[sector];
              if (near) {
                share = 0.0;
                for (const double one : shares) share += one;
              }
              shares_.push_back(static_cast<float>(share));
            }
        }
    }
  }

  /// Means over the ground about a place, by channel, of what is seen along the line of sight and what comes back. `sky`:
  /// what the sky is brighter by, by place; null: nothing. `squares`: mean squares of what is seen along it; or null.
  void mean(const GroundLight& ground, double x_m, double y_m, std::size_t finest, const AdjacentGround* sky,
            const std::vector<std::size_t>& first_node, float* up, float* down, float* squares) const {
    if (squares != nullptr) std::fill_n(squares, channels_, 0.0f);
    std::fill_n(up, channels_, 0.0f);
    std::fill_n(down, channels_, 0.0f);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const double x = x_m + places_[k].x_m, y = y_m + places_[k].y_m;
      const GroundLight::Corners at = ground.at(x, y, places_[k].cell_m, finest);
      if (!at.any) continue;
      const float *of_up = shares_.data() + 2 * k * channels_, *of_down = of_up + channels_,
                  *w = at.weight.data();
      std::optional<AdjacentGround::Corners> brighter;
      if (sky != nullptr) brighter = sky->at(x, y);
      for (std::size_t c = 0; c < channels_; ++c) {
        float value = (at.beyond[0][c] * w[0] + at.beyond[1][c] * w[1]) +
                      (at.beyond[2][c] * w[2] + at.beyond[3][c] * w[3]);
        if (brighter) {
          float more = 0.0f;
          for (std::size_t j = 0; j < 4; ++j) more += brighter->weight[j] * brighter->sky[j][first_node[c]];
          value += more * ((at.skylit[0][c] * w[0] + at.skylit[1][c] * w[1]) +
                           (at.skylit[2][c] * w[2] + at.skylit[3][c] * w[3]));
        }
        up[c] += of_up[c] * value;
        down[c] += of_down[c] * value;
        if (squares != nullptr) squares[c] += of_up[c] * value * value;
      }
    }
  }

 private:
  struct Place {
    double x_m, y_m, cell_m;
  };
  std::size_t channels_;
  std::vector<Place> places_;
  std::vector<float> shares_;  // [place][up, down][channel]
};

/// Fills the grid's places from means over the ground about them.
class Filling {
 public:
  Filling(const transport::SpectralScene& scene, std::span<const double> spherical_albedo,
          const GroundLight& ground, const Surrounding& around, int threads)
      : scene_(scene),
        spherical_albedo_(spherical_albedo),
        ground_(ground),
        around_(around),
        threads_(threads) {
    for (std::size_t c = 0; c < ground.channels(); ++c) first_node_.push_back(scene.nodes().first_node(c));
  }

  void fill(AdjacentGround& grid, const AdjacentGround* sky, std::size_t finest = 0) const {
    parallel_for(static_cast<std::int64_t>(grid.across()), threads_, [&](std::int64_t j) {
      const std::size_t row = static_cast<std::size_t>(j), channels = ground_.channels();
      std::vector<float> up(channels), down(channels);
      for (std::size_t column = 0; column < grid.across(); ++column) {
        mean(grid.x_m(column), grid.y_m(row), finest, sky, up, down);
        float *radiance = grid.radiance(column, row), *more = grid.sky(column, row);
        for (std::size_t c = 0; c < channels; ++c)
          for (std::size_t n = scene_.nodes().first_node(c); n < scene_.nodes().first_node(c + 1); ++n) {
            const double brightness = ground_.node_brightness()[n];
            const double open = static_cast<double>(scene_.sky_radiance()[n]);
            radiance[n] = static_cast<float>(static_cast<double>(up[c]) * brightness);
            more[n] = open > 0.0 ? static_cast<float>(static_cast<double>(down[c]) * brightness *
                                                      spherical_albedo_[n] / open)
                                 : 0.0f;
          }
      }
    });
  }
  void mean(double x_m, double y_m, std::size_t finest, const AdjacentGround* sky, std::vector<float>& up,
            std::vector<float>& down, std::vector<float>* squares = nullptr) const {
    around_.mean(ground_, x_m, y_m, finest, sky, first_node_, up.data(), down.data(),
                 squares != nullptr ? squares->data() : nullptr);
  }

 private:
  const transport::SpectralScene& scene_;
  std::span<const double> spherical_albedo_;
  const GroundLight& ground_;
  const Surrounding& around_;
  int threads_;
  std::vector<std::size_t> first_node_;
};

double square(double x) { return x * x; }

/// How far path radiance may be off, by channel, at 95 of 100 places: rasters of twice the cells, straight lines between places, photons.
std::vector<double> path_errors(const transport::SpectralScene& scene, const GroundLight& ground,
                                const Filling& filling, const AdjacentGround& grid,
                                const std::vector<atmosphere::ChannelSpread>& spreads) {
  const std::size_t channels = ground.channels(), across = grid.across();
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<float> up(channels), down(channels), coarse(channels), squares(channels);
  std::vector<double> cells(channels, 0.0), lines(channels, 0.0), photons(channels, 0.0);
  for (std::size_t j = 0; j < kErrorChecks; ++j)
    for (std::size_t i = 0; i < kErrorChecks; ++i) {
      const std::size_t column = (across - 2) * (2 * i + 1) / (2 * kErrorChecks),
                        row = (across - 2) * (2 * j + 1) / (2 * kErrorChecks);
      const double x = 0.5 * (grid.x_m(column) + grid.x_m(column + 1)),
                   y = 0.5 * (grid.y_m(row) + grid.y_m(row + 1));
      filling.mean(x, y, 0, nullptr, up, down, &squares);
      filling.mean(x, y, 1, nullptr, coarse, down);
      const AdjacentGround::Corners at = grid.at(x, y);
      for (std::size_t c = 0; c < channels; ++c) {
        cells[c] += square(static_cast<double>(up[c] - coarse[c]));
        photons[c] += std::max(0.0, static_cast<double>(squares[c]) - square(static_cast<double>(up[c])));
        const std::size_t n = nodes.first_node(c);
        float between = 0.0f;
        for (std::size_t k = 0; k < 4; ++k) between += at.weight[k] * at.radiance[k][n];
        const double brightness = ground.node_brightness()[n];
        if (brightness > 0.0)
          lines[c] += square(static_cast<double>(between) / brightness - static_cast<double>(up[c]));
      }
    }
  std::vector<double> errors(channels, 0.0);
  for (std::size_t c = 0; c < channels; ++c) {
    double diffuse = 0.0;
    for (std::size_t n = nodes.first_node(c); n < nodes.first_node(c + 1); ++n)
      diffuse +=
          nodes.node_weight(n) * static_cast<double>(scene.view_diffuse()[n]) * ground.node_brightness()[n];
    // Shares of photons add up to 1: what is uncertain of their mean is how far from it their ground is.
    const double effective = spreads[c].up.effective_photons();
    const double of_photons = effective > 0.0 ? photons[c] / effective : 0.0;
    constexpr double kPlaces = static_cast<double>(kErrorChecks * kErrorChecks);
    errors[c] = diffuse * kConfident * std::sqrt((cells[c] + lines[c] + of_photons) / kPlaces);
  }
  return errors;
}

}  // namespace

std::shared_ptr<const AdjacentGround> adjacent_ground(const transport::SpectralScene& scene,
                                                      std::span<const double> spherical_albedo,
                                                      const std::vector<atmosphere::ChannelSpread>& spreads,
                                                      const sensor::Camera& camera, int threads) {
  const geometry::World& world = *scene.scene().world;
  if (world.storage().chunks > 0) return nullptr;
  const std::optional<AdjacentGround::Area> area = seen_area(world, camera);
  if (!area) return nullptr;
  const GroundLight ground(scene, *area, threads);
  bool any = false;
  for (std::size_t c = 0; c < ground.channels(); ++c) any = any || ground.contrast(c) > kSameGround;
  if (!any) return nullptr;
  const math::Vec3 towards_sensor = -camera.middle_ray().direction;
  const double reach_m = 1e3 * GroundSpread::inner_edges_km().back();
  const Surrounding around(spreads, std::atan2(towards_sensor.y, towards_sensor.x), 0.5 * ground.cell_m(),
                           reach_m);
  const Filling filling(scene, spherical_albedo, ground, around, threads);
  const std::size_t across = ground.cells_across() / 2 + 1;
  AdjacentGround first(*area, across, scene.node_count());
  filling.fill(first, nullptr);
  std::vector<double> errors = path_errors(scene, ground, filling, first, spreads);
  // Ground under a brighter sky is brighter itself.
  auto second = std::make_shared<AdjacentGround>(*area, across, scene.node_count());
  filling.fill(*second, &first);
  second->path_error = std::move(errors);
  return second;
}

}  // namespace ifov::render
