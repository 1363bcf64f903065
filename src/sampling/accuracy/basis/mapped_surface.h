#pragma once

#include <span>

namespace ifov::sampling {

struct FocalPoint;

/// What the maps of a surface (temperatures, textures, mixtures) say about points of the focal plane near one that shows it, without
/// a ray: all are taken to show the same surface, flat about that point.
class MappedSurface {
 public:
  virtual ~MappedSurface() = default;

  /// Rows of Field::stride() floats, in the order of the points and the columns of values. `own`: what the surface gives off, as it
  /// reaches the sensor, with what the air adds, and the shares of its materials; `reflectance`: 0 to 1, of light that falls
  /// there from all sides. 0 in columns of which the maps say nothing.
  virtual void look_up(std::span<const FocalPoint> points, std::span<float> own,
                       std::span<float> reflectance) const = 0;
};

}  // namespace ifov::sampling
