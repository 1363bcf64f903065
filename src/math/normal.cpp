#include "math/normal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ifov::math {
namespace {

using Coefficients = std::array<double, 8>;

/// Rational approximations in the middle, at the sides and far out; the constant of each denominator is 1.
constexpr Coefficients kMiddle = {
    3.3871328727963666080e0,  1.3314166789178437745e+2, 1.9715909503065514427e+3, 1.3731693765509461125e+4,
    4.5921953931549871457e+4, 6.7265770927008700853e+4, 3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr Coefficients kBelowMiddle = {1.0,
                                       4.2313330701600911252e+1,
                                       6.8718700749205790830e+2,
                                       5.3941960214247511077e+3,
                                       2.1213794301586595867e+4,
                                       3.9307895800092710610e+4,
                                       2.8729085735721942674e+4,
                                       5.2264952788528545610e+3};
constexpr Coefficients kSide = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                5.76949722146069140550e0,  3.64784832476320460504e0,
                                1.27045825245236838258e0,  2.41780725177450611770e-1,
                                2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Coefficients kBelowSide = {1.0,
                                     2.05319162663775882187e0,
                                     1.67638483018380384940e0,
                                     6.89767334985100004550e-1,
                                     1.48103976427480074590e-1,
                                     1.51986665636164571966e-2,
                                     5.47593808499534494600e-4,
                                     1.05075007164441684324e-9};
constexpr Coefficients kFar = {6.65790464350110377720e0,  5.46378491116411436990e0,
                               1.78482653991729133580e0,  2.96560571828504891230e-1,
                               2.65321895265761230930e-2, 1.24266094738807843860e-3,
                               2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Coefficients kBelowFar = {1.0,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};

double ratio(const Coefficients& above, const Coefficients& below, double x) {
  double a = 0.0, b = 0.0;
  for (std::size_t k = above.size(); k-- > 0;) a = a * x + above[k], b = b * x + below[k];
  return a / b;
}

constexpr double kMiddleTo = 0.425;

double in_middle(double from_middle) {
  return from_middle * ratio(kMiddle, kBelowMiddle, kMiddleTo * kMiddleTo - from_middle * from_middle);
}

double outside_middle(double probability) {
  const double from_middle = probability - 0.5;
  const double r = std::sqrt(-std::log(from_middle < 0.0 ? probability : 1.0 - probability));
  const double at = r <= 5.0 ? ratio(kSide, kBelowSide, r - 1.6) : ratio(kFar, kBelowFar, r - 5.0);
  return from_middle < 0.0 ? -at : at;
}

}  // namespace

double normal_quantile(double probability) {
  return std::abs(probability - 0.5) <= kMiddleTo ? in_middle(probability - 0.5)
                                                  : outside_middle(probability);
}

void normal_quantiles(std::span<double> probabilities) {
  constexpr std::size_t kAtOnce = 256;
  std::array<double, kAtOnce> middle;
  for (std::size_t first = 0; first < probabilities.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, probabilities.size() - first);
    double* __restrict p = probabilities.data() + first;
    // Without a branch, so that several are worked out at once; where it does not hold, it is not taken.
    for (std::size_t k = 0; k < count; ++k) middle[k] = in_middle(p[k] - 0.5);
    for (std::size_t k = 0; k < count; ++k)
      p[k] = std::abs(p[k] - 0.5) <= kMiddleTo ? middle[k] : outside_middle(p[k]);
  }
}

}  // namespace ifov::math
