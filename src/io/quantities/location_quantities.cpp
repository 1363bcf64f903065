#include "io/quantities/location_quantities.h"

#include <limits>
#include <vector>

#include "io/quantities/acquisition.h"
#include "io/quantities/layer_values.h"
#include "truth/location.h"
#include "truth/view_angles.h"

namespace ifov::io::quantities {
namespace {

std::vector<double> map_positions(const FinishedTile& of, const truth::Collector& noted) {
  const sampling::TileLayer* const layer = of.tile.layer(noted.name);
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

template <const truth::Collector& noted>
void put_locations(const FinishedTile& of, ValueSink& sink) {
  sink.put(map_positions(of, noted));
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
                                   .values = put_locations<truth::kLocation>};

constinit const Quantity kTrueLocation{.name = "true_location",
                                       .what = "place of what the middle of each pixel really sees",
                                       .unit = "m",
                                       .role = Quantity::Role::truth,
                                       .statistic = Quantity::Statistic::middle,
                                       .type = EnviType::float64,
                                       .bands = Quantity::Bands::named,
                                       .band_names = kPositionBands,
                                       .collector = &truth::kTrueLocation,
                                       .values = put_locations<truth::kTrueLocation>};

constinit const Quantity kViewAngles{.name = "view_angles",
                                     .what = "direction from the place to the sensor",
                                     .unit = "deg",
                                     .role = Quantity::Role::truth,
                                     .statistic = Quantity::Statistic::middle,
                                     .type = EnviType::float32,
                                     .bands = Quantity::Bands::named,
                                     .band_names = kAngleBands,
                                     .collector = &truth::kViewAngles,
                                     .values = put_layer<truth::kViewAngles, float>};

}  // namespace ifov::io::quantities
