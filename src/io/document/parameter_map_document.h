#pragma once

#include "io/document/map_document.h"

namespace ifov::io {

/// A parameter of a scattering model from place to place, in its SI unit: number in the raster x unit + offset.
struct ParameterMap {
  RasterDocument raster;
  int band = 1;  ///< from 1
  double unit = 1.0, offset = 0.0;
};

}  // namespace ifov::io
