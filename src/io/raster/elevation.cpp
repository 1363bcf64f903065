#include "io/raster/elevation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "io/raster/fill_unknown.h"
#include "io/raster/raster.h"

namespace ifov::io {

namespace {

/// No ground is deeper or higher: numbers beyond stand for cells without a height.
constexpr double kDeepest_m = -12000.0, kHighest_m = 100000.0;
constexpr double kFoot_m = 0.3048, kSurveyFoot_m = 1200.0 / 3937.0;

double metres_per(const std::string& unit, const std::string& name) {
  std::string lower = unit;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (lower.empty() || lower == "m" || lower == "metre" || lower == "meter" || lower == "metres" ||
      lower == "meters")
    return 1.0;
  if (lower == "ft" || lower == "foot" || lower == "feet") return kFoot_m;
  if (lower == "us-ft" || lower == "us survey foot" || lower == "ftus") return kSurveyFoot_m;
  if (lower == "cm") return 0.01;
  throw InputError(format("{}: the unit of its heights is '{}'; give 'unit'", name, unit));
}

}  // namespace

Elevation read_elevation(const std::filesystem::path& path, int band, std::optional<double> unit_m,
                         UnknownHeights unknown) {
  Raster raster = read_band(path, band);
  const std::string name = path.string();
  const std::size_t cells = raster.cells();
  const double factor = unit_m ? *unit_m : metres_per(raster.units[0], name);
  Elevation terrain{raster.width, raster.height,       std::move(raster.values),    0,
                    false,        raster.geotransform, std::move(raster.projection)};
  for (std::size_t k = 0; k < cells; ++k) {
    float& value = terrain.height_m[k];
    const float number = value;
    const bool missing =
        !std::isfinite(value) || (raster.nodata && value == static_cast<float>(*raster.nodata));
    terrain.unknown += missing ? 1 : 0;
    value = missing ? std::numeric_limits<float>::quiet_NaN()
                    : static_cast<float>(factor * static_cast<double>(value));
    if (value < kDeepest_m || value > kHighest_m)
      throw InputError(format(
          "{}: {:g} at row {}, column {} is no height in metres ({:g}): if it means that there is none, the file "
          "must say so (gdal_translate -a_nodata {:g}), else give 'unit'",
          name, number, k / static_cast<std::size_t>(raster.width) + 1,
          k % static_cast<std::size_t>(raster.width) + 1, value, number));
  }
  if (terrain.unknown == cells) throw InputError(format("{}: no cell has a height", name));
  if (terrain.unknown > 0 && unknown == UnknownHeights::fill) {
    fill_unknown(terrain.height_m, terrain.width, terrain.height, name);
    terrain.filled = true;
  }
  return terrain;
}

}  // namespace ifov::io
