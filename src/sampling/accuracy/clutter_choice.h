#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace ifov::sampling {

class AllowedErrors;
class Contrast;
class LabelSpread;
class Lattice;
class Radiance;
class SteeringColumns;
class TileRecall;
class TracedPixels;
struct LatticeValues;
struct OutputState;
struct SourcePixel;

/// Leaves pixels to stratified samples over the whole of them: before tracing where that is cheaper, as the lattice has it;
/// after it where values contradict what was traced.
class ClutterChoice {
 public:
  ClutterChoice(const Lattice& lattice, const LatticeValues& values, const Contrast& contrast,
                const TileRecall& recall, const SteeringColumns& steering);

  /// Abandons pixels that are cheaper so, and limits what tracing may spend on the others. 1 for pixels that would be
  /// cheaper so, but whose few values could overlook what lies between their few labels: they are left to the caller.
  std::vector<std::uint8_t> choose(const AllowedErrors& errors, const LabelSpread& spread,
                                   TracedPixels& pixels);

  /// The pixel holds this label between those that the lattice has met there.
  void expect(int pixel, std::uint32_t label, TracedPixels& pixels);

  /// The pixel will take this many values, or more.
  void expect_values(int pixel, double count) {
    predicted_[pixel] = std::max(predicted_[pixel], static_cast<float>(count));
  }

  /// Values that each source pixel would take as clutter; 0 where that was not asked or all its vertices have one label.
  std::span<const float> predicted() const { return predicted_; }

  /// Turns to clutter what values contradict, if `doubt`, and plans the first round of all clutter that has none; false
  /// where there is no such round.
  bool begin_rounds(bool doubt, Radiance& radiance, std::vector<OutputState>& outputs) const;

 private:
  bool doubtful(const SourcePixel& pixel) const;
  double first_round(const SourcePixel& pixel) const;

  const Lattice& lattice_;
  const LatticeValues& values_;
  const Contrast& contrast_;
  const TileRecall& recall_;
  const SteeringColumns& steering_;
  std::vector<float> predicted_;
};

}  // namespace ifov::sampling
