#pragma once

#include <memory>

#include "io/raster/gdal_functions.h"

namespace ifov::io {

struct ReleaseReference {
  void operator()(void* reference) const { late::OSRDestroySpatialReference(reference); }
};
/// GDAL's coordinate reference system.
using ReferenceHandle = std::unique_ptr<void, ReleaseReference>;

}  // namespace ifov::io
