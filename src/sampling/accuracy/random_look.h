#pragma once

#include <cstdint>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

class LabelTable;
class Lattice;
class RayLedger;
class SourceGrid;
struct LatticeValues;

/// Random points of every pixel, which the seed moves: the lattice may be in step with what it looks at.
class RandomLook {
 public:
  /// `side`^2 points in each pixel; none where it is 0.
  RandomLook(const SourceGrid& grid, const Lattice& lattice, int side, std::uint64_t seed)
      : grid_(grid), lattice_(lattice), side_(side), seed_(seed) {}

  int side() const { return side_; }
  /// Whether the source pixel weighs enough to be looked at.
  bool covers(int source) const;
  /// Others each round.
  std::vector<FocalPoint> points(int source, int round = 0) const;

  /// Labels whose values agree at all vertices draw no values in their pixels: whether they are alike elsewhere is looked
  /// at here, with values, into at.random. Returns the other source pixels, whose points are to be asked for their labels
  /// when borders are traced.
  std::vector<int> test_constant_labels(RayLedger& ledger, const LabelTable& table, LatticeValues& at) const;

 private:
  bool constant_at_vertices(int source, const LatticeValues& at) const;

  const SourceGrid& grid_;
  const Lattice& lattice_;
  int side_;
  std::uint64_t seed_;
};

}  // namespace ifov::sampling
