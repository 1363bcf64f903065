#include "session/assembly/atmosphere/adjacency_assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/sensor/channel_spread.h"
#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/format.h"
#include "geometry/world.h"
#include "io/document/atmosphere_document.h"
#include "io/document/scene_document.h"
#include "render/adjacency/adjacency.h"
#include "scene/scene.h"
#include "session/assembly/atmosphere/atmosphere_assembly.h"
#include "transport/sky/adjacent_ground.h"

namespace ifov::session {
namespace {

constexpr double kFarAway_km = 1e3;
constexpr double kTellBeyond = 0.1;  // shares above it are told

/// The distance within which half of the light starts.
double half_distance_km(const atmosphere::GroundSpread& spread) {
  double near = 1e-3, far = kFarAway_km;
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(near * far);
    (spread.within(middle) < 0.5 ? near : far) = middle;
  }
  return far;
}

/// From the middle of the bounded things to their nearest side; endless where there is a plane.
double scene_reach_km(const geometry::World& world) {
  for (std::size_t k = 0; k < world.object_count(); ++k)
    if (!std::isfinite(world.object(k).radius_m)) return std::numeric_limits<double>::infinity();
  if (world.period()) return std::numeric_limits<double>::infinity();
  const geometry::World::Bounds bounds = world.bounds();
  return 0.5e-3 * std::min(bounds.high_m.x - bounds.low_m.x, bounds.high_m.y - bounds.low_m.y);
}

std::string distance(double km) { return km < 1.0 ? format("{:.0f} m", 1e3 * km) : format("{:.2g} km", km); }

}  // namespace

AssembledAdjacency assemble_adjacency(const io::ModelledAtmosphere& written, const io::OriginDocument& origin,
                                      const AtmosphereSubject& subject,
                                      const atmosphere::SensorAtmosphere& air,
                                      const transport::SpectralScene& lit, int threads) {
  if (!written.adjacency)
    return {nullptr, "ground in the air: the surroundings alone (\"adjacency\": false)"};
  if (subject.scene.world->storage().chunks > 0)
    return {
        nullptr,
        "ground in the air: the surroundings alone, as looking at all of a scene whose trees are made when rays come "
        "near would make them all"};
  const atmosphere::AtmosphereColumn column = assemble_column(subject.sources, written, origin);
  const std::vector<atmosphere::ChannelSpread> spreads =
      atmosphere::channel_spreads(column, subject.channels, air.geometry(), threads);
  AssembledAdjacency result{
      render::adjacent_ground(lit, air.spherical_albedo(), spreads, subject.camera, threads), {}};
  if (result.ground == nullptr) {
    result.statement = "ground in the air: as the surroundings everywhere";
    return result;
  }
  double near_km = kFarAway_km, far_km = 0.0, beyond = 0.0;
  const double reach_km = scene_reach_km(*subject.scene.world);
  for (const atmosphere::ChannelSpread& spread : spreads) {
    if (!(spread.up.transmittance() > 0.0)) continue;
    const double half_km = half_distance_km(spread.up);
    near_km = std::min(near_km, half_km), far_km = std::max(far_km, half_km);
    beyond = std::max(beyond, 1.0 - spread.up.within(reach_km));
  }
  result.statement = format(
      "ground in the air: the scene's own, half of its light from within {}",
      near_km < 0.9 * far_km ? format("{} to {}", distance(near_km), distance(far_km)) : distance(far_km));
  if (beyond > kTellBeyond)
    result.statement +=
        format(", {:.0f} % from beyond the scene, where the surroundings are taken", 100.0 * beyond);
  return result;
}

}  // namespace ifov::session
