#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ifov/api.h"

namespace ifov {

class CancelToken;

/// A picture that a program makes itself, as the accuracy sampler asks for it: pixel (i, j) covers [i, i+1) x [j, j+1), x to the right,
/// y downwards. It is asked up to a pixel beyond the image, too. The answer to a point must not depend on the other points of the call.
class IFOV_API FieldFunction {
 public:
  virtual ~FieldFunction() = default;

  /// Numbers in a value, 1 to 64.
  virtual int columns() const = 0;

  /// Random numbers in [0, 1) that a value takes, 0 to 64: of a function that is itself a mean over them. They are stratified together
  /// with the places.
  virtual int random_numbers() const { return 0; }

  /// Which part of the picture each point belongs to: within a part values are alike or vary smoothly, borders between parts are traced.
  virtual void labels(std::span<const double> x, std::span<const double> y,
                      std::span<std::uint64_t> labels) = 0;

  /// Its labels, and values[k * columns() + column]; random[k * random_numbers() + number].
  virtual void values(std::span<const double> x, std::span<const double> y, std::span<const double> random,
                      std::span<std::uint64_t> labels, std::span<double> values) = 0;
};

struct IntegrationOptions {
  double error = 0.01;       ///< largest half-width that is allowed, above 0: in the unit of the values, or
  bool relative = false;     ///< as a share of the pixel's value
  double floor = 0.0;        ///< in the unit of the values: where values are smaller, the share is of this
  double confidence = 0.95;  ///< with which each interval holds the mean over its pixel
  std::uint64_t seed = 1;
  std::uint32_t max_samples = 1u << 16;  ///< a pixel
  int lattice = 3;  ///< cells along a pixel's side of the lattice on which parts are looked for, 1 to 32
  const CancelToken* cancel = nullptr;
};

/// Means over pixels: arrays hold [pixel * columns + column], pixels row by row.
struct IntegratedImage {
  int width = 0, height = 0, columns = 0;
  std::vector<float> mean, half_width;
  // By pixel:
  std::vector<std::uint32_t> samples;  ///< points that were asked for
  std::vector<std::uint16_t>
      reasons;  ///< why the half-widths are not as small as allowed, as in products; 0: they are
  std::vector<float>
      missable_fraction;  ///< largest part, as a share of the pixel, that may have been missed with a probability of 5 %
};

/// Means of a picture over its pixels by the accuracy sampler, with intervals (docs/theory/accuracy_sampler.md): more points where parts meet
/// and where values scatter. In the calling thread. Throws std::invalid_argument on options out of their range and on values that are
/// not finite; what the field throws; Cancelled.
IFOV_API IntegratedImage integrate(FieldFunction& field, int width, int height,
                                   const IntegrationOptions& options);

}  // namespace ifov
