#pragma once

#include <span>

#include "atmosphere/sensor/directions/sky_directions.h"

namespace ifov::atmosphere {

/// The table's directions and the middles between them: every second one is of the table.
SkyDirections halved(const SkyDirections& table);

/// How wrong the sky's irradiance of an inclined surface is, at worst, where the sky is linear between the
/// directions of a table: relative, of the light of this sky and, where a surface faces the Sun, of the
/// direct beam (of this irradiance across itself). `radiance` holds the sky at the directions of
/// halved(table), [zenith][azimuth]. Surfaces are inclined by 30, 60 and 90 degrees, towards the Sun, across
/// and away; what the table gives a level surface is right (SensorAtmosphere scales it). Errors of the second
/// order: those between the halved table's own directions count as a third of what is seen.
/// `beyond_at_sun`: what the table has at the Sun beyond `radiance`.
double inclined_error(const SkyDirections& table, std::span<const double> radiance, double beam,
                      double sun_zenith_rad, double beyond_at_sun = 0.0);

}  // namespace ifov::atmosphere
