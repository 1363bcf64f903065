#pragma once

#include <cstddef>
#include <vector>

#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

class LabelSpread;
class LeafIntegrator;
class NearbySpread;
class TracedPixels;

/// A group of source pixels, with what the traced model says of each.
class SourcePixels {
 public:
  /// `width`: of the domain, in pixels.
  SourcePixels(const TracedPixels& traced, const LabelSpread& spread, const NearbySpread& nearby, int width)
      : traced_(traced), spread_(spread), nearby_(nearby), width_(width) {}

  /// Source pixels [first, last), once.
  void add(int first, int last, const LeafIntegrator& integrator);
  /// Before any value is planned: follows what tracing has changed. False where pixels must be added anew.
  bool refresh(const LeafIntegrator& integrator);
  /// Leaves the pixel's traced model for rounds over the whole of it.
  void turn_to_clutter(std::size_t pixel);

  const std::vector<PlainPixel>& plain() const { return plain_; }
  std::vector<SourcePixel>& others() { return others_; }
  const std::vector<SourcePixel>& others() const { return others_; }

 private:
  void fill(SourcePixel& pixel, const LeafIntegrator& integrator) const;
  void find_neighbours();

  const TracedPixels& traced_;
  const LabelSpread& spread_;
  const NearbySpread& nearby_;
  int width_;
  std::vector<PlainPixel> plain_;
  std::vector<SourcePixel> others_;
};

}  // namespace ifov::sampling
