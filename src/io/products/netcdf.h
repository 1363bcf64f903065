#pragma once

#include <cstdint>

#include "io/product_parts/product_kinds.h"
#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"
#include "io/products/part_file.h"

namespace ifov::io {

/// The cubes a NetCDF file holds; those that are empty are left away.
struct NetcdfInput {
  RasterView radiance, standard_error, half_width;
};

/// Writes the radiance over (wavelength, y, x), with its errors as ancillary variables, by the CF conventions 1.8: classic
/// NetCDF with 64-bit offsets, which all readers know, or with 64-bit data where a variable is too large for that.
/// ifov::EnvironmentError on full disks.
void write_netcdf(PartFile& file, const NetcdfInput& input, const RunRecord& record);

/// Disk space that this takes, but for what is small.
std::uint64_t netcdf_bytes(const render::ImageInfo& info, ProductSet cubes);

}  // namespace ifov::io
