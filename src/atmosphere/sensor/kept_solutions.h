#pragma once

#include <span>

namespace ifov::atmosphere {

/// What solved columns gave, kept by all that it depends on. Both are numbers in an order of the caller's own. Serves several threads.
class KeptSolutions {
 public:
  virtual ~KeptSolutions() = default;
  /// Whether the answer to exactly this question is known, with as many numbers as there is room for: then it is there.
  virtual bool find(std::span<const double> question, std::span<double> answer) = 0;
  virtual void keep(std::span<const double> question, std::span<const double> answer) = 0;
};

}  // namespace ifov::atmosphere
