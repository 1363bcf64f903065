#pragma once

#include <span>

namespace ifov::sampling {

/// The user's accuracy as a sampler sees it: how large the half-width of each column's interval may be. Where the limits come from (kelvins, percent, reflectance, radiance) is the business of
/// `render`.
class Tolerance {
 public:
  virtual ~Tolerance() = default;

  /// limit[c] > 0 for a pixel whose columns have these means, in the units of the columns; infinity where column c is not judged. Smooth in the mean: samplers call it at every look.
  virtual void limits(std::span<const double> mean, std::span<double> limit) const = 0;

  /// As limits(), of a pixel that holds these `count` materials, on which they may depend (by_material()); none: it is not known which.
  virtual void limits_holding(const struct Abundance* /*held*/, std::size_t /*count*/,
                              std::span<const double> mean, std::span<double> limit) const {
    limits(mean, limit);
  }
  virtual bool by_material() const { return false; }

  /// Probability with which each pixel's interval is to hold the true mean, per column (already corrected where the user asked for simultaneous confidence).
  virtual double confidence() const = 0;
};

}  // namespace ifov::sampling
