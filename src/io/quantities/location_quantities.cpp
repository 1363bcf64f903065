#include "io/quantities/location_quantities.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "io/quantities/acquisition.h"
#include "render/tile_sink.h"
#include "truth/location.h"

namespace ifov::io::quantities {
namespace {

std::vector<double> map_positions(const FinishedTile& of) {
  const sampling::TileLayer* const layer = of.tile.layer(truth::kLocation.name);
  if (layer == nullptr)
    return std::vector<double>(3 * of.tile.samples.size(), std::numeric_limits<double>::quiet_NaN());
  const std::span<const double> in_scene = layer->values<double>();
  std::vector<double> positions(in_scene.begin(), in_scene.end());
  const math::Point3 origin = of.acquisition.origin_on_map_m;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    positions[i] += origin.x;
    positions[i + 1] += origin.y;
    positions[i + 2] += origin.z;
  }
  return positions;
}

void put_locations(const FinishedTile& of, ValueSink& sink) { sink.put(map_positions(of)); }

void put_view_angles(const FinishedTile& of, ValueSink& sink) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> positions = map_positions(of);
  const Acquisition::Camera& camera = of.acquisition.camera;
  std::vector<float> angles;
  angles.reserve(2 * of.tile.samples.size());
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const math::Point3 position{positions[i], positions[i + 1], positions[i + 2]};
    const math::Vec3 to_sensor =
        math::normalized(camera.position_m ? *camera.position_m - position : -camera.forward);
    const double zenith = std::atan2(std::hypot(to_sensor.x, to_sensor.y), to_sensor.z) * kDegrees,
                 azimuth = std::atan2(to_sensor.x, to_sensor.y) * kDegrees;
    const bool known = !std::isnan(position.x);
    angles.push_back(known ? static_cast<float>(zenith) : kUnknown);
    angles.push_back(known ? static_cast<float>(azimuth < 0.0 ? azimuth + 360.0 : azimuth) : kUnknown);
  }
  sink.put(angles);
}

constexpr std::string_view kPositionBands[] = {"easting", "northing", "height"},
                           kAngleBands[] = {"view zenith", "view azimuth"};

}  // namespace

constinit const Quantity kLocation{.name = "location",
                                   .what = "place of what the middle of each pixel sees",
                                   .unit = "m",
                                   .role = Quantity::Role::truth,
                                   .statistic = Quantity::Statistic::middle,
                                   .type = EnviType::float64,
                                   .bands = Quantity::Bands::named,
                                   .band_names = kPositionBands,
                                   .usual = Quantity::Usual::where_no_map_tells,
                                   .collector = &truth::kLocation,
                                   .values = put_locations};

constinit const Quantity kViewAngles{.name = "view_angles",
                                     .what = "direction from the place to the sensor",
                                     .unit = "deg",
                                     .role = Quantity::Role::truth,
                                     .statistic = Quantity::Statistic::middle,
                                     .type = EnviType::float32,
                                     .bands = Quantity::Bands::named,
                                     .band_names = kAngleBands,
                                     .collector = &truth::kLocation,
                                     .values = put_view_angles};

}  // namespace ifov::io::quantities
