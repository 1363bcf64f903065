#include "io/raster/elevation.h"

#include <gdal.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/error.h"
#include "io/raster/quiet_gdal.h"
#include "io/raster/raster.h"

namespace ifov::io {

namespace {

constexpr double kFoot_m = 0.3048, kSurveyFoot_m = 1200.0 / 3937.0;

double metres_per(const std::string& unit, const std::string& name) {
  std::string lower = unit;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (lower.empty() || lower == "m" || lower == "metre" || lower == "meter" || lower == "metres" || lower == "meters")
    return 1.0;
  if (lower == "ft" || lower == "foot" || lower == "feet") return kFoot_m;
  if (lower == "us-ft" || lower == "us survey foot" || lower == "ftus") return kSurveyFoot_m;
  if (lower == "cm") return 0.01;
  throw InputError(format("{}: the unit of its heights is '{}'; give 'unit'", name, unit));
}

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};

/// A band in memory that GDAL's algorithms can work on.
template <class T>
std::unique_ptr<void, CloseDataset> memory_band(std::vector<T>& values, int width, int height, GDALDataType type) {
  std::unique_ptr<void, CloseDataset> set(
      GDALCreate(GDALGetDriverByName("MEM"), "", width, height, 1, type, nullptr));
  if (!set || GDALRasterIO(GDALGetRasterBand(set.get(), 1), GF_Write, 0, 0, width, height, values.data(), width,
                           height, type, 0, 0) != CE_None)
    throw EnvironmentError("no memory to fill holes of a terrain");
  return set;
}

void fill(Elevation& terrain, const std::string& name) {
  const QuietGdal gdal;
  std::vector<unsigned char> known;
  for (float& value : terrain.height_m) {
    known.push_back(std::isfinite(value) ? 255 : 0);
    if (!std::isfinite(value)) value = 0.0f;
  }
  const auto heights = memory_band(terrain.height_m, terrain.width, terrain.height, GDT_Float32);
  const auto mask = memory_band(known, terrain.width, terrain.height, GDT_Byte);
  const double everywhere = std::hypot(terrain.width, terrain.height);
  const GDALRasterBandH band = GDALGetRasterBand(heights.get(), 1);
  if (GDALFillNodata(band, GDALGetRasterBand(mask.get(), 1), everywhere, 0, 0, nullptr, nullptr, nullptr) != CE_None ||
      GDALRasterIO(band, GF_Read, 0, 0, terrain.width, terrain.height, terrain.height_m.data(), terrain.width,
                   terrain.height, GDT_Float32, 0, 0) != CE_None)
    throw InputError(format("{}: the holes cannot be filled: {}", name, gdal.message()));
}

}  // namespace

Elevation read_elevation(const std::filesystem::path& path, int band, std::optional<double> unit_m,
                         UnknownHeights unknown) {
  Raster raster = read_raster(path);
  const std::string name = path.string();
  if (band < 1 || band > raster.bands)
    throw InputError(format("{} has no band {}; it has {}", name, band, raster.bands));
  const std::size_t cells = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height);
  const double factor = unit_m ? *unit_m : metres_per(raster.units[static_cast<std::size_t>(band - 1)], name);
  Elevation terrain{raster.width, raster.height, {}, 0, false, raster.geotransform, std::move(raster.projection)};
  const auto first = raster.values.begin() + static_cast<std::ptrdiff_t>(cells) * (band - 1);
  terrain.height_m.assign(first, first + static_cast<std::ptrdiff_t>(cells));
  for (float& value : terrain.height_m) {
    const bool missing =
        !std::isfinite(value) || (raster.nodata && value == static_cast<float>(*raster.nodata));
    terrain.unknown += missing ? 1 : 0;
    value = missing ? std::numeric_limits<float>::quiet_NaN()
                    : static_cast<float>(factor * static_cast<double>(value));
  }
  if (terrain.unknown == cells) throw InputError(format("{}: no cell has a height", name));
  if (terrain.unknown > 0 && unknown == UnknownHeights::fill) {
    fill(terrain, name);
    terrain.filled = true;
  }
  return terrain;
}

}  // namespace ifov::io
