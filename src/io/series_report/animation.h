#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/product_parts/picture.h"

namespace ifov::io {

/// Pictures of one channel over the times of a series, one colour scale for all of them.
struct Animation {
  std::string title, unit;         ///< "K"
  std::vector<std::string> times;  ///< as they are printed, a frame each
  Range range;
  std::function<Layer(std::size_t time)> layer;  ///< all of one size; read one after the other
};

/// An animated GIF; what holds no value is grey. Throws SystemError where it cannot be drawn.
std::string make_animation(const Animation& animation);

}  // namespace ifov::io
