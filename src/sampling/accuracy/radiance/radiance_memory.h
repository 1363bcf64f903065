#pragma once

#include <cstddef>

namespace ifov::sampling {

class LabelTable;
class TileMemory;
struct KeptValues;
struct SourcePixel;

/// What a run leaves of its values in a tile's memory for a later one at a tighter tolerance, and how that takes them up.
class RadianceMemory {
 public:
  /// `kept` is null where no values are.
  RadianceMemory(const LabelTable& table, KeptValues* kept, std::size_t stride)
      : table_(table), kept_(kept), stride_(stride) {}

  /// Keeps what a later run may go on from; `predicted` values were expected of it as clutter.
  void remember(const SourcePixel& pixel, double predicted, TileMemory& memory) const;
  /// Takes up the values that an earlier run left of the pixel, where they still fit what is traced. False where some
  /// do not: these are left out.
  bool recall(SourcePixel& pixel, const TileMemory& memory) const;

  /// Values that an earlier run has spent on a source pixel as clutter, and how many had been expected; 0 where it was
  /// not.
  struct ClutterBefore {
    double values = 0.0, predicted = 0.0;
  };
  static ClutterBefore clutter_before(const TileMemory& memory, int source);

 private:
  const LabelTable& table_;
  KeptValues* kept_;
  std::size_t stride_;
};

}  // namespace ifov::sampling
