#pragma once

#include "sampling/pixel_rect.h"

namespace ifov::sampling {

class Lattice;
class PixelFootprint;
struct TileProblem;

/// The source pixels that a tile looks at: those its footprints reach and `halo` more, within the image grown
/// by the footprint's reach.
PixelRect source_domain(const TileProblem& problem, int halo);
/// Pixels that a footprint reaches beyond its own, on each side.
int reach_of(const PixelFootprint& footprint);

/// How source pixels (row-major indices in the lattice's domain) and the output pixels of a tile lie to each other.
class SourceGrid {
 public:
  SourceGrid(const Lattice& lattice, const PixelFootprint& footprint, PixelRect tile)
      : lattice_(lattice), footprint_(footprint), tile_(tile) {}

  const PixelRect& tile() const { return tile_; }
  /// The output pixel at a source pixel's place, or the nearest to it.
  int nearest_output(int source) const;
  /// The source pixel at an output pixel's place.
  int source_of(int output) const;
  /// Weight of a source pixel in the output where it weighs most, relative to that of the output's own pixel.
  double relative_weight(int source) const;

 private:
  const Lattice& lattice_;
  const PixelFootprint& footprint_;
  PixelRect tile_;
};

}  // namespace ifov::sampling
