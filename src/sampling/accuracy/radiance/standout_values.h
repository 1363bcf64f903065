#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ifov::sampling {

class LabelSpread;
class Lattice;
class RayLedger;
class SteeringColumns;
struct FocalPoint;
struct LatticeValues;
struct ThinShadow;

/// Values at points of which the field knows that something stands out there (KnownDetail::standouts). No estimate contains them: they
/// tell how far from a pixel's values something lies that these may not have met. So do values in the dark where something thin hides
/// a small part of the Sun: no ray to its rim need tell of that, and few values meet it.
class StandoutValues {
 public:
  StandoutValues(const Lattice& lattice, const LatticeValues& values) : lattice_(lattice), values_(values) {}

  /// One value a point, and one in the dark for each pixel with thin shadows; what lies beside the lattice's domain is left out.
  void ask(std::span<const FocalPoint> points, std::span<const ThinShadow> shadows, RayLedger& ledger,
           std::uint64_t seed);

  /// 1 over the variance allowed to a source pixel, by column; valid until the next call.
  using InverseSquares = std::function<std::span<const double>(int source)>;
  /// Finds the pixels whose vertices show nothing like their standouts. Columns that tell these apart steer from here on.
  void judge(const LabelSpread& spread, const InverseSquares& allowed, SteeringColumns& steering);

  /// By how many allowed standard errors of the pixel the farthest of its standouts lies beyond what differs about the vertex that is
  /// most like it; 0: it has none.
  double apart(int pixel) const { return pixel < static_cast<int>(apart_.size()) ? apart_[pixel] : 0.0; }
  /// Square of how far from `mean` lies the farthest of the pixel's standouts; 0: it has none. What a thin shadow takes from the mean
  /// is known to be no more than its share: of it no more counts than that share times `times`.
  double farthest_square(int pixel, int column, double mean, double times) const;

 private:
  double beyond_nearest(int pixel, const float* value, const LabelSpread& spread,
                        std::span<const double> inverse, int& column) const;

  double shadow_apart(int pixel, std::size_t row, std::span<const double> inverse, int& column) const;

  const Lattice& lattice_;
  const LatticeValues& values_;
  std::size_t stride_ = 0;
  std::vector<std::size_t> first_;  // of the pixel's rows, and the end; empty: there are no standouts
  std::vector<float> rows_;
  std::vector<float> shares_;  // of each row: of a thin shadow, or 0
  std::vector<double> apart_;  // by pixel; empty: there are no standouts
};

}  // namespace ifov::sampling
