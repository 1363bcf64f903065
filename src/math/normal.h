#pragma once

#include <span>

namespace ifov::math {

/// The value below which a normal variable of mean 0 and variance 1 lies with a probability between 0 and 1 (excluded), to about 16
/// digits (Wichura 1988, Algorithm AS 241: the percentage points of the normal distribution, Applied Statistics 37, 477-484).
double normal_quantile(double probability);

/// The same of many, in place.
void normal_quantiles(std::span<double> probabilities);

}  // namespace ifov::math
