#include "session/assembly/geometry/random_placement_assembly.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "core/overloaded.h"
#include "sampling/random_placement.h"
#include "session/assembly/shared/raster_assembly.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using sampling::Point2;

enum class Purpose { prototype, turn, scale };

constexpr double kPer_ha = 1e4;
constexpr double kAbove_m = 1e5;  ///< rays start so far above the scene's origin

/// How dense copies are to stand.
struct Density {
  double peak_m2 = 0.0;
  std::function<double(Point2)> at_m2;  ///< of a place in the document; empty: the peak everywhere
};

/// Rows or columns of a map without tiling that an interval, in cells, meets; beyond its edges it goes on.
std::pair<int, int> met(double from, double to, int count) {
  const auto inside = [count](double v) {
    return static_cast<int>(std::clamp(std::floor(v), 0.0, count - 1.0));
  };
  return {inside(from), inside(to)};
}

Density density_from(const io::DensityMap& map, const sampling::PlacementArea& area, const MapFrame& frame) {
  const std::string& path = map.raster.file.path;
  const io::Raster raster = io::read_raster(path);
  const materials::MapGrid grid = grid_of(map.raster, raster, frame);
  const std::span<const float> band = band_of(raster, map.band, path);
  const math::Vec3 offset_m = frame.offset_m();
  std::vector<double> density_m2(band.size());
  for (std::size_t k = 0; k < band.size(); ++k) {
    const double value = band[k];
    const bool known =
        std::isfinite(value) && (!raster.nodata || static_cast<float>(*raster.nodata) != band[k]);
    if (known && value < 0.0)
      throw InputError(format("the density map '{}' holds {} at row {}, column {}: densities are 0 or more",
                              path, value, k / static_cast<std::size_t>(raster.width) + 1,
                              k % static_cast<std::size_t>(raster.width) + 1));
    density_m2[k] = known ? value * map.density_of_one_m2 : 0.0;
  }
  Density density;
  std::pair<int, int> columns{0, grid.width - 1}, rows{0, grid.height - 1};
  if (grid.tiling == materials::Tiling::edge) {
    columns = met((area.west_m - offset_m.x - grid.west_m) / grid.cell_width_m,
                  (area.east_m - offset_m.x - grid.west_m) / grid.cell_width_m, grid.width);
    rows = met((grid.north_m - area.north_m + offset_m.y) / grid.cell_height_m,
               (grid.north_m - area.south_m + offset_m.y) / grid.cell_height_m, grid.height);
  }
  for (int row = rows.first; row <= rows.second; ++row)
    for (int column = columns.first; column <= columns.second; ++column)
      density.peak_m2 = std::max(
          density.peak_m2, density_m2[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                                      static_cast<std::size_t>(column)]);
  density.at_m2 = [grid, offset_m, density_m2 = std::move(density_m2)](Point2 p) {
    return density_m2[grid.cell_at({p.x - offset_m.x, p.y - offset_m.y})];
  };
  return density;
}

/// What is asked for over an area: its mean, and the share of the area where it is more than `most_m2`.
struct Asked {
  double mean_m2 = 0.0, share_above = 0.0;
};

Asked asked_of(const Density& density, const sampling::PlacementArea& area, double most_m2) {
  if (!density.at_m2) return {density.peak_m2, density.peak_m2 > most_m2 ? 1.0 : 0.0};
  constexpr int kSide = 500;
  Asked asked;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double here_m2 =
          density.at_m2({area.west_m + (column + 0.5) / kSide * (area.east_m - area.west_m),
                         area.south_m + (row + 0.5) / kSide * (area.north_m - area.south_m)});
      asked.mean_m2 += here_m2 / (kSide * kSide);
      if (here_m2 > most_m2) asked.share_above += 1.0 / (kSide * kSide);
    }
  return asked;
}

std::string names_of(const io::RandomPlacement& source) {
  std::string names;
  for (const auto& weighted : source.of)
    names += format("{}'{}'", names.empty() ? "" : ", ", weighted.prototype.name);
  return names;
}

std::size_t pick(const io::RandomPlacement& source, double u) {
  double total = 0.0;
  for (const auto& weighted : source.of) total += weighted.weight;
  double rest = u * total;
  for (std::size_t k = 0; k + 1 < source.of.size(); ++k) {
    rest -= source.of[k].weight;
    if (rest < 0.0) return k;
  }
  return source.of.size() - 1;
}

/// Heights of the topmost surface below the sky, in the coordinates of the document; none: there is no
/// surface.
std::vector<std::optional<double>> heights_of(const std::vector<sampling::RandomPosition>& positions,
                                              const geometry::World& ground, math::Vec3 offset_m) {
  std::vector<math::Ray> rays;
  rays.reserve(positions.size());
  for (const auto& position : positions)
    rays.push_back(
        {{position.at_m.x - offset_m.x, position.at_m.y - offset_m.y, kAbove_m}, {0.0, 0.0, -1.0}});
  std::vector<geometry::SurfacePoint> hits(rays.size());
  ground.intersect(rays, hits);
  std::vector<std::optional<double>> heights;
  for (const geometry::SurfacePoint& hit : hits)
    heights.push_back(hit.hit() ? std::optional(hit.position_m.z + offset_m.z) : std::nullopt);
  return heights;
}

}  // namespace

std::vector<std::vector<io::Instance>> random_copies(const io::DocumentSources& sources,
                                                     const io::RandomPlacement& source, const MapFrame& frame,
                                                     const geometry::World* ground, LogSink* log) {
  const sampling::PlacementArea area{source.low_m[0], source.low_m[1], source.high_m[0], source.high_m[1]};
  return with_position(sources, source.density_position, [&] {
    const Density density =
        std::visit(Overloaded{[](double even_m2) {
                                return Density{even_m2, {}};
                              },
                              [&](const io::DensityMap& map) { return density_from(map, area, frame); }},
                   source.density_m2);
    const std::vector<sampling::RandomPosition> positions = sampling::random_positions(
        {area, source.minimum_distance_m, density.peak_m2, density.at_m2, source.seed});
    std::vector<std::optional<double>> heights(positions.size(), source.height_m);
    if (ground != nullptr) heights = heights_of(positions, *ground, frame.offset_m());

    std::vector<std::vector<io::Instance>> copies(source.of.size());
    std::size_t placed = 0;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      if (!heights[k]) continue;
      const auto draw = [&](Purpose what) {
        return sampling::unit_double(sampling::extend(positions[k].key, what));
      };
      io::Instance copy{{positions[k].at_m.x, positions[k].at_m.y, *heights[k]}};
      if (source.turn)
        copy.quaternion = io::quaternion_of(2.0 * std::numbers::pi * draw(Purpose::turn), 0.0, 0.0);
      const double scale = source.scale[0] + (source.scale[1] - source.scale[0]) * draw(Purpose::scale);
      copy.scale = {scale, scale, scale};
      copies[pick(source, draw(Purpose::prototype))].push_back(copy);
      ++placed;
    }
    if (log == nullptr) return copies;
    const std::string names = names_of(source);
    const double most_m2 = sampling::largest_placement_density(source.minimum_distance_m);
    const Asked asked = asked_of(density, area, most_m2);
    log->info(format("random placement of {}: {} copies, {:.4g} ha-1 (asked for: {:.4g} ha-1)", names, placed,
                     static_cast<double>(placed) / area.square_metres() * kPer_ha, asked.mean_m2 * kPer_ha));
    if (density.peak_m2 > most_m2)
      log->warn(format(
          "random placement of {}: at a distance of {} m at least, {:.4g} ha-1 stand, not {:.4g} ha-1 as asked for on "
          "{:.3g} % of the area; lower 'density' or 'minimum_distance'",
          names, source.minimum_distance_m, most_m2 * kPer_ha, density.peak_m2 * kPer_ha,
          100.0 * asked.share_above));
    if (positions.empty())
      log->warn(format(
          "random placement of {}: no copies stand there, {:.3g} are expected on its {:.4g} m2: is 'density' or 'area' of another "
          "unit?",
          names, asked.mean_m2 * area.square_metres(), area.square_metres()));
    if (placed < positions.size())
      log->warn(
          format("random placement of {}: {} of {} places have nothing of '{}' under them and stay empty",
                 names, positions.size() - placed, positions.size(), source.on->name));
    return copies;
  });
}

}  // namespace ifov::session
