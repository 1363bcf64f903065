#include "studies/atmosphere/atmosphere_results.h"

#include <algorithm>
#include <cmath>

namespace ifov::studies {

void Differences::add(double value, double reference) {
  const double difference = value - reference;
  sum_ += difference;
  squares_ += difference * difference;
  largest_ = std::max(largest_, std::abs(difference));
  ++count_;
}

double Differences::rms() const { return count_ > 0 ? std::sqrt(squares_ / count_) : 0.0; }

}  // namespace ifov::studies
