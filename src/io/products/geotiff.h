#pragma once

#include "io/products/part_file.h"
#include "io/products/raster_view.h"
#include "io/products/run_record.h"

namespace ifov::io {

/// Writes the radiance as a GeoTIFF into `file`: bands described by channel name, with wavelengths as GDAL's
/// ENVI driver ("wavelength", "wavelength_units") and its IMAGERY domain ("CENTRAL_WAVELENGTH_UM", "FWHM_UM")
/// give them. ifov::EnvironmentError on full disks.
void write_geotiff(PartFile& file, const RasterView& radiance, const RunRecord& record);

}  // namespace ifov::io
