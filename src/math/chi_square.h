#pragma once

#include <vector>

/// Whether counts are those of a distribution (Pearson's test).
namespace ifov::math {

/// Upper tail Q(a, x) of the regularised incomplete gamma function (series below a + 1, continued fraction above).
double upper_gamma(double a, double x);

/// Probability of a statistic at least this large where the hypothesis holds.
double chi_square_p_value(double statistic, double degrees_of_freedom);

/// p-value of counts against expected counts of the same sum; cells that expect fewer than 5 are pooled, and
/// one that expects nothing yet was hit refutes at once.
double chi_square_test(const std::vector<double>& observed, const std::vector<double>& expected);

}  // namespace ifov::math
