#include "io/raster/fill_unknown.h"

#include <cmath>
#include <memory>

#include "core/error.h"
#include "io/raster/gdal_dataset.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {
namespace {

/// A band in memory that GDAL's algorithms can work on.
template <class T>
Dataset memory_band(std::vector<T>& values, int width, int height, GDALDataType type) {
  Dataset set(late::GDALCreate(late::GDALGetDriverByName("MEM"), "", width, height, 1, type, nullptr));
  if (!set || late::GDALRasterIO(late::GDALGetRasterBand(set.get(), 1), GF_Write, 0, 0, width, height,
                                 values.data(), width, height, type, 0, 0) != CE_None)
    throw SystemError("no memory to fill the holes of a raster");
  return set;
}

}  // namespace

void fill_unknown(std::vector<float>& values, int width, int height, const std::string& name) {
  const QuietGdal gdal;
  std::vector<unsigned char> known;
  for (float& value : values) {
    known.push_back(std::isfinite(value) ? 255 : 0);
    if (!std::isfinite(value)) value = 0.0f;
  }
  const auto numbers = memory_band(values, width, height, GDT_Float32);
  const auto mask = memory_band(known, width, height, GDT_Byte);
  const double everywhere = std::hypot(width, height);
  const GDALRasterBandH band = late::GDALGetRasterBand(numbers.get(), 1);
  if (late::GDALFillNodata(band, late::GDALGetRasterBand(mask.get(), 1), everywhere, 0, 0, nullptr, nullptr,
                           nullptr) != CE_None ||
      late::GDALRasterIO(band, GF_Read, 0, 0, width, height, values.data(), width, height, GDT_Float32, 0,
                         0) != CE_None)
    throw InputError(format("{}: the holes cannot be filled: {}", name, gdal.message()));
}

}  // namespace ifov::io
