#include "io/products/cube_values.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace ifov::io {

std::vector<float> air_half_widths(const sampling::TileResult& tile, const render::ImageInfo& info) {
  std::vector<float> air(tile.mean.size(), 0.0f);
  for (std::size_t i = 0; i < air.size(); ++i)
    if (const auto& channel = info.channels[i % info.channels.size()]; channel.air)
      air[i] = static_cast<float>(channel.air->of(tile.mean[i]));
  return air;
}

std::vector<std::uint32_t> sample_counts(const sampling::TileResult& tile) {
  std::vector<std::uint32_t> counts;
  counts.reserve(3 * tile.samples.size());
  for (std::size_t p = 0; p < tile.samples.size(); ++p)
    counts.insert(counts.end(), {tile.samples[p], tile.label_rays[p], tile.radiance_evaluations[p]});
  return counts;
}

std::vector<float> quality_values(const sampling::TileResult& tile) {
  std::vector<float> quality;
  quality.reserve(4 * tile.samples.size());
  for (std::size_t p = 0; p < tile.samples.size(); ++p)
    quality.insert(quality.end(), {tile.converged(p) ? 1.0f : 0.0f, tile.worst_ratio[p],
                                   tile.missable_fraction[p], tile.share_of_borders(p)});
  return quality;
}

std::vector<float> fractions(const sampling::TileResult& tile, std::size_t materials,
                             float sampling::Abundance::*member) {
  std::vector<float> values(tile.samples.size() * materials, 0.0f);
  for (const sampling::Abundance& a : tile.abundances) {
    if (a.pixel >= tile.samples.size() || a.material >= materials)
      throw std::logic_error("a tile's abundance names no pixel or no material");
    values[a.pixel * materials + a.material] = a.*member;
  }
  return values;
}

std::vector<double> map_positions(const sampling::TileResult& tile, const Acquisition& acquisition) {
  if (tile.position_m.empty())
    return std::vector<double>(3 * tile.samples.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<double> places = tile.position_m;
  const math::Point3 origin = acquisition.origin_on_map_m;
  for (std::size_t i = 0; i < places.size(); i += 3) {
    places[i] += origin.x;
    places[i + 1] += origin.y;
    places[i + 2] += origin.z;
  }
  return places;
}

std::vector<float> view_angles(const sampling::TileResult& tile, const Acquisition& acquisition) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const std::vector<double> places = map_positions(tile, acquisition);
  const Acquisition::Camera& camera = acquisition.camera;
  std::vector<float> angles;
  angles.reserve(2 * tile.samples.size());
  for (std::size_t i = 0; i < places.size(); i += 3) {
    const math::Point3 place{places[i], places[i + 1], places[i + 2]};
    const math::Vec3 to_sensor =
        math::normalized(camera.is_frame ? camera.position_m - place : -camera.forward);
    const double zenith = std::atan2(std::hypot(to_sensor.x, to_sensor.y), to_sensor.z) * kDegrees,
                 azimuth = std::atan2(to_sensor.x, to_sensor.y) * kDegrees;
    const bool known = !std::isnan(place.x);
    angles.push_back(known ? static_cast<float>(zenith) : std::numeric_limits<float>::quiet_NaN());
    angles.push_back(known ? static_cast<float>(azimuth < 0.0 ? azimuth + 360.0 : azimuth)
                           : std::numeric_limits<float>::quiet_NaN());
  }
  return angles;
}

}  // namespace ifov::io
