#pragma once

#include <filesystem>

#include "io/raster/raster.h"

namespace ifov::io {

/// Writes numbers 0 to 255 as 8-bit bands by GDAL: a GeoTIFF (`.tif`, compressed) or a PNG (`.png`), with the
/// raster's georeference in the former. The same raster gives the same bytes. Throws SystemError where the
/// file cannot be written.
void write_byte_raster(const std::filesystem::path& path, const Raster& raster);

}  // namespace ifov::io
