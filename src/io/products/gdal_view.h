#pragma once

#include <gdal_priv.h>

#include <memory>

#include "io/product_parts/raster_view.h"

namespace ifov::io {

/// A raster that GDAL reads through a view, line by line; what the view throws is a failure of GDAL's. Keeps a reference.
std::unique_ptr<GDALDataset> gdal_view(const RasterView& view);

}  // namespace ifov::io
