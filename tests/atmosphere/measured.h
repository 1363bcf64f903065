#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/format.h"

namespace ifov::test {

/// Differences of a run of comparisons.
class Measured {
 public:
  void add(double at, double value, double reference) {
    const double difference = value - reference;
    sum_ += difference;
    squares_ += difference * difference;
    ++count_;
    if (std::abs(difference) > largest_) largest_ = std::abs(difference), where_ = at;
  }
  double rms() const { return std::sqrt(squares_ / std::max(count_, 1)); }
  double mean() const { return sum_ / std::max(count_, 1); }
  double largest() const { return largest_; }
  int count() const { return count_; }
  std::string text() const {
    return format("{} points, mean {:+.5f}, rms {:.5f}, largest {:.5f} at {:.6g}", count_, mean(), rms(),
                  largest_, where_);
  }
  /// Kept in the test's XML record under this name.
  void record(const std::string& name) const { testing::Test::RecordProperty(name, text()); }

 private:
  double sum_ = 0.0, squares_ = 0.0, largest_ = 0.0, where_ = 0.0;
  int count_ = 0;
};

}  // namespace ifov::test
