#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::materials {

/// Directions above the horizon whose density goes by their cosine alone, about in proportion to `level`(cosine) x cosine, which is linear
/// between tabulated square roots of the cosine.
class CosineLobe {
 public:
  CosineLobe() = default;
  /// `level`: at least 0. Where it is 0 everywhere the lobe is Lambert's.
  explicit CosineLobe(const std::function<double(double cosine)>& level);

  math::Vec3 sample(sampling::Point2 u) const;
  double density(double cosine) const;  ///< 1/sr
  sampling::Point2 invert(math::Vec3 direction) const;

 private:
  std::vector<double> height_, below_;  // density of t = sqrt(cosine) at knots; share of the lobe below them
};

}  // namespace ifov::materials
