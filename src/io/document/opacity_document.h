#pragma once

#include "io/document/map_document.h"

namespace ifov::io {

/// Where a material is not there: in cells whose number is below `cutoff`, or that have none.
struct OpacityDocument {
  RasterDocument raster;
  int band = 1;  ///< from 1
  double cutoff = 0.0;
};

}  // namespace ifov::io
