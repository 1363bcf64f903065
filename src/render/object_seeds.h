#pragma once

#include <vector>

#include "geometry/world.h"
#include "sampling/tile.h"
#include "sensor/camera.h"

namespace ifov::render {

/// Where to look for objects that the detection lattice could miss: the image of the seed point of every compact
/// object that is smaller than a pixel in some direction, by pixel. Objects that are longer than a pixel but thinner
/// get a point for each part of their length.
class ObjectSeeds {
 public:
  ObjectSeeds(const geometry::World& world, const sensor::Camera& camera, double margin_px);

  /// Points within `margin_px` of a tile, in order of pixel and object.
  std::vector<sampling::FocalPoint> near(sampling::PixelRect tile, double margin_px) const;
  std::size_t count() const { return points_.size(); }

 private:
  std::vector<sampling::FocalPoint> points_;  // sorted by row, then object
  std::vector<std::size_t> first_of_row_;     // rows from lowest_row_
  int lowest_row_ = 0;
};

}  // namespace ifov::render
