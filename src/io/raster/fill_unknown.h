#pragma once

#include <string>
#include <vector>

namespace ifov::io {

/// Gives the cells of a raster that are not finite a value by GDAL's rule (GDALFillNodata without smoothing): the mean of
/// the nearest known cells in the four quadrants, weighted by the inverse of their distance. `values` row by row, some of
/// them finite; `name` of the raster, for the error. Throws InputError where GDAL cannot, SystemError without memory.
void fill_unknown(std::vector<float>& values, int width, int height, const std::string& name);

}  // namespace ifov::io
