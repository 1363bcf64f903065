#pragma once

#include <memory>
#include <string>

#include "io/raster/gdal_functions.h"

namespace ifov::io {

struct CloseDataset {
  void operator()(void* dataset) const { late::GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

/// Opens what GDAL knows by a name with the drivers of raster_driver_list(), and no others; null where none of them can.
void* open_raster(const std::string& gdal_name);

}  // namespace ifov::io
