#pragma once

#include "sampling/pixel_rect.h"

namespace ifov::sampling {

class Lattice;
class ColumnFootprints;
struct TileProblem;

/// The source pixels that a tile looks at: those its footprints reach, so many pixels beyond their own, and `halo` more, within the image grown by that reach.
PixelRect source_domain(const TileProblem& problem, int reach, int halo);

/// How source pixels (row-major indices in the lattice's domain) and the output pixels of a tile lie to each other.
class SourceGrid {
 public:
  SourceGrid(const Lattice& lattice, const ColumnFootprints& footprints, PixelRect tile)
      : lattice_(lattice), footprints_(footprints), tile_(tile) {}

  const PixelRect& tile() const { return tile_; }
  /// The output pixel at a source pixel's place, or the nearest to it.
  int nearest_output(int source) const;
  /// The source pixel at an output pixel's place.
  int source_of(int output) const;
  /// Weight of a source pixel in the output and the group of columns where it weighs most, relative to that of the output's own pixel or, where a footprint is shifted, of the pixel that it is
  /// about.
  double relative_weight(int source) const;

 private:
  const Lattice& lattice_;
  const ColumnFootprints& footprints_;
  PixelRect tile_;
};

}  // namespace ifov::sampling
