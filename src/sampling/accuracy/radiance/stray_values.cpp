#include "sampling/accuracy/radiance/stray_values.h"

#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/lattice.h"
#include "sampling/accuracy/borders/border_model.h"
#include "sampling/accuracy/edges/contradictions.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// A value on the wrong side of a curve is no sign of anything missed if it is at most this much farther from it than
/// the width to which the curve is known.
constexpr double kBorderSlack_px = 0.02;

}  // namespace

bool StrayValues::belongs(Stratum& stratum, FocalPoint point, std::uint32_t label, const float* value) const {
  if (!contradictions_.disagrees(point, label, kBorderSlack_px)) {
    // Labels that look alike are not traced apart: what values say of the one belongs to the other, however unlike it is.
    const auto pixel = static_cast<std::uint32_t>(model_.tree().lattice().pixel_at(point));
    return !contradictions_.matters(pixel, stratum.label, label) && model_.label_at(point) == stratum.label;
  }
  const std::size_t stride = static_cast<std::size_t>(field_.stride());
  stratum.strays += 1.0;
  stratum.stray_sum.resize(stride, 0.0);
  stratum.stray_squares.resize(stride, 0.0);
  const double* mean = table_.mean(stratum.label);
  for (int c = 0; c < field_.columns(); ++c) {
    const double d = value[c] - mean[c];
    stratum.stray_sum[c] += d;
    stratum.stray_squares[c] += d * d;
  }
  return model_.label_at(point) == stratum.label;
}

}  // namespace ifov::sampling
