#include "io/raster/raster_writer.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/raster/gdal_dataset.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {
namespace {

GDALDriverH driver_named(const char* name) {
  prepare_gdal();
  const GDALDriverH driver = late::GDALGetDriverByName(name);
  if (driver == nullptr) throw SystemError(format("GDAL has no driver '{}' here", name));
  return driver;
}

/// The raster in memory, as GDAL sees it.
Dataset in_memory(const Raster& raster) {
  Dataset dataset(late::GDALCreate(driver_named("MEM"), "", raster.width, raster.height, raster.bands,
                                   GDT_Byte, nullptr));
  if (!dataset) throw SystemError("memory ran out for a raster");
  std::vector<std::uint8_t> row(static_cast<std::size_t>(raster.width));
  for (int band = 0; band < raster.bands; ++band)
    for (int y = 0; y < raster.height; ++y) {
      for (int x = 0; x < raster.width; ++x)
        row[static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(std::lround(raster.at(band, y, x)));
      if (late::GDALRasterIO(late::GDALGetRasterBand(dataset.get(), band + 1), GF_Write, 0, y, raster.width,
                             1, row.data(), raster.width, 1, GDT_Byte, 0, 0) != CE_None)
        throw SystemError("a raster cannot be filled");
    }
  if (raster.geotransform) {
    std::array<double, 6> transform = *raster.geotransform;
    late::GDALSetGeoTransform(dataset.get(), transform.data());
  }
  if (!raster.projection.empty()) late::GDALSetProjection(dataset.get(), raster.projection.c_str());
  return dataset;
}

}  // namespace

void write_byte_raster(const std::filesystem::path& path, const Raster& raster) {
  const bool is_png = path.extension() == ".png";
  const GDALDriverH driver = driver_named(is_png ? "PNG" : "GTiff");
  const QuietGdal quiet;
  const Dataset source = in_memory(raster);
  char** options = nullptr;
  if (!is_png) {
    options = late::CSLSetNameValue(options, "COMPRESS", "DEFLATE");
    options = late::CSLSetNameValue(options, "TILED", "YES");
  }
  // A PNG's georeference would go to a file beside it.
  const NoSidecars none;
  const Dataset written(
      late::GDALCreateCopy(driver, path.c_str(), source.get(), FALSE, options, nullptr, nullptr));
  late::CSLDestroy(options);
  if (!written) throw SystemError(format("cannot write '{}': {}", path.string(), late::CPLGetLastErrorMsg()));
}

}  // namespace ifov::io
