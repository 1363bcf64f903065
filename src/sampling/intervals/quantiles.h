#pragma once

#include <map>

namespace ifov::sampling {

/// x with P(-x < N(0,1) < x) = confidence, 0 < confidence < 1, to double precision.
double two_sided_normal(double confidence);

/// The same for Student's t with `degrees_of_freedom` > 0, to 1e-12 relative. Takes some microseconds.
double two_sided_student(double confidence, double degrees_of_freedom);

/// Two-sided quantiles at one confidence, each computed once.
class StudentTable {
 public:
  explicit StudentTable(double confidence) : confidence_(confidence) {}
  double operator()(int degrees_of_freedom) {
    double& quantile = quantiles_[degrees_of_freedom];
    if (quantile == 0.0) quantile = two_sided_student(confidence_, degrees_of_freedom);
    return quantile;
  }

 private:
  double confidence_;
  std::map<int, double> quantiles_;
};

}  // namespace ifov::sampling
