#pragma once

#include "sampling/random.h"

namespace ifov::sampling {

class BorderModel;
class Lattice;
struct Cell;
struct Junction;
struct JunctionCheck;

/// Width of the error of the middle of a straight leg that was not verified, as a share of the leg.
constexpr double kUnverifiedLeg = 0.15;

/// The point, moved into the cell, where it is not well inside.
Point2 into_cell(const Lattice& lattice, const Cell& cell, Point2 p);

/// Where the three borders of a junction should meet, by the neighbouring borders.
class JunctionPredictor {
 public:
  explicit JunctionPredictor(const BorderModel& model) : model_(model) {}

  /// Fills in a check of which no more than the cell is known: where the first rays go.
  void predict(JunctionCheck& check) const;

  /// Whether a junction that was located once is to be located better.
  bool too_vague(const Junction& junction) const;

 private:
  double leg_tolerance(const Junction& junction, int border, Point2 leg) const;

  const BorderModel& model_;
};

}  // namespace ifov::sampling
