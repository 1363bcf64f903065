#pragma once

#include <cstdint>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"

namespace ifov::io {

/// Writes the radiance as a Cloud Optimized GeoTIFF into `file`: tiles, overviews, and gaps as not a number. Bands carry the
/// channel's name, unit, wavelengths as GDAL's ENVI driver gives them ("wavelength", "wavelength_units"; no other domain
/// than the default one passes GDAL's COG driver), and red, green or blue where the picture shows them so.
/// ifov::SystemError on full disks.
void write_geotiff(PartFile& file, const RasterView& radiance, const RunRecord& record);

/// Disk space that this takes at most while it is made.
std::uint64_t geotiff_bytes(const render::ImageInfo& info);

namespace formats {
extern const ProductFormat kGeotiff;
}

}  // namespace ifov::io
