#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"
#include "io/quantities/quantity_set.h"

namespace ifov::io {

struct SummaryTable;

/// A quantity with a band for each channel.
struct NetcdfCube {
  const Quantity* quantity;
  RasterView view;
};

/// Writes cubes over (wavelength, y, x), the first one's errors and so on as ancillary variables of it, by the CF conventions 1.8: classic
/// NetCDF with 64-bit offsets, which all readers know, or with 64-bit data where a variable is too large for that.
/// ifov::SystemError on full disks.
void write_netcdf(PartFile& file, const std::vector<NetcdfCube>& input, const RunRecord& record);

/// A table along the dimension `channel`, by the same conventions. ifov::SystemError where it cannot be written.
void write_netcdf(const std::filesystem::path& path, const SummaryTable& table);

/// Disk space that this takes, but for what is small.
std::uint64_t netcdf_bytes(const render::ImageInfo& image, const QuantitySet& quantities);

namespace formats {
extern const ProductFormat kNetcdf;
}

}  // namespace ifov::io
