#pragma once

#include <string>

#include "io/raster/raster.h"

namespace ifov::landscape {

/// What varies within a material.
enum class Grain {
  turf,        ///< tufts and blades, 4 cm to 1.3 m
  aggregate,   ///< stones, wheel tracks' wear and oil, 4 cm to 5 m
  slabs,       ///< slabs of 1.5 m with joints, each of its own shade
  weathering,  ///< streaks and single tiles
};

/// A square picture of it, brightness 0 to 255, that repeats without seams.
struct TextureTile {
  std::string name;
  double size_m = 1.0;
  io::Raster raster;
};

TextureTile texture_tile(Grain grain);

}  // namespace ifov::landscape
