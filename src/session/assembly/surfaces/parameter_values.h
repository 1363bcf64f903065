#pragma once

#include <string>
#include <vector>

namespace ifov::io {
struct ParameterMap;
struct Raster;
}  // namespace ifov::io
namespace ifov::materials {
struct BsdfParameter;
}

namespace ifov::session {

/// A parameter in the cells of its map, in its SI unit.
struct ParameterValues {
  std::vector<float> by_cell;    ///< row by row from the north-west corner
  std::vector<double> distinct;  ///< those that occur, rising
  double mean = 0.0;
};

/// Throws InputError, which names the cell, where the raster has no number or one that the parameter may not be.
ParameterValues parameter_values(const io::ParameterMap& map, const io::Raster& raster,
                                 const materials::BsdfParameter& parameter);

}  // namespace ifov::session
