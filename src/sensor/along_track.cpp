#include "sensor/along_track.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensor/mtf.h"

namespace ifov::sensor {

std::vector<sampling::PixelFootprint::Piece> AlongTrack::pieces() const {
  const double wide = std::max(exposure_px, element_px), narrow = std::min(exposure_px, element_px);
  // Of one look, a trapezoid: its height falls over `narrow` about the ends of `wide`.
  const auto look = [&](double y) {
    if (narrow <= 0.0) return std::abs(y) < 0.5 * wide ? 1.0 / wide : 0.0;
    return std::clamp((0.5 * (wide + narrow) - std::abs(y)) / narrow, 0.0, 1.0) / wide;
  };
  std::vector<double> knots, looks;
  for (int s = 0; s < stages; ++s) {
    const double at = (s - 0.5 * (stages - 1)) * stage_px;
    looks.push_back(at);
    for (const double end :
         {-0.5 * (wide + narrow), -0.5 * (wide - narrow), 0.5 * (wide - narrow), 0.5 * (wide + narrow)})
      knots.push_back(at + end);
  }
  std::sort(knots.begin(), knots.end());
  constexpr double kSame_px = 1e-12;
  std::vector<sampling::PixelFootprint::Piece> pieces;
  double before = knots.front();
  for (const double knot : knots) {
    if (!(knot - before > kSame_px)) continue;
    // Straight between knots: two points within tell it, at ends where it may step as well.
    const double third = (knot - before) / 3.0;
    double at_first = 0.0, at_second = 0.0;
    for (const double at : looks) at_first += look(before + third - at), at_second += look(knot - third - at);
    pieces.push_back(
        {before, knot, std::max(0.0, 2.0 * at_first - at_second), std::max(0.0, 2.0 * at_second - at_first)});
    before = knot;
  }
  return pieces;
}

double AlongTrack::mtf(double cycles_px) const {
  const double turn = std::numbers::pi * stage_px * cycles_px, one = std::sin(turn);
  const double comb = std::abs(one) < 1e-9 ? 1.0 : std::sin(stages * turn) / (stages * one);
  return std::abs(square_mtf(exposure_px, cycles_px) * square_mtf(element_px, cycles_px) * comb);
}

}  // namespace ifov::sensor
