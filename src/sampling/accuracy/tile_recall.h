#pragma once

#include <memory>
#include <span>
#include <vector>

namespace ifov::sampling {

class Radiance;
class TileMemory;
struct OutputState;
struct TileProblem;
struct TileResult;

/// A tile that an earlier run has left at a looser tolerance: what is taken up from there, and left in turn.
class TileRecall {
 public:
  TileRecall(const TileProblem& problem, int columns);
  ~TileRecall();

  /// Of the run before, where there is one; for the next, where it is to be kept; else null.
  TileMemory* memory() { return memory_.get(); }

  /// Outputs go on with the tests at which the run before ended.
  void recall_tests(std::vector<OutputState>& outputs) const;
  /// Takes up what is known of pixel number `pixel` of the group.
  void recall_values(Radiance& radiance, std::size_t pixel, std::vector<OutputState>& outputs) const;
  /// Of all pixels of the group.
  void recall_values(Radiance& radiance, std::vector<OutputState>& outputs) const;
  /// Values that clutter still takes by the lattice's prediction, where an earlier run has begun, and has shown
  /// what such predictions are worth in the pixel.
  double clutter_to_come(int source, double predicted) const;

  /// Keeps the values of a group; `predicted` ones were expected of each source pixel as clutter.
  void remember_values(const Radiance& radiance, std::span<const float> predicted);
  /// Adds the counts of the run before to those of this one, and what is kept.
  void finish(const std::vector<OutputState>& outputs, TileResult& result);

 private:
  const TileProblem& problem_;
  std::unique_ptr<TileMemory> memory_;
};

}  // namespace ifov::sampling
