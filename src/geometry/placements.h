#pragma once

#include <cstddef>

#include "math/transform.h"

namespace ifov::geometry {

/// Where the copies of something stand: a list that may be much longer than one would keep as matrices. Answers are
/// the same each time and may be asked for from several threads.
class Placements {
 public:
  virtual ~Placements() = default;
  virtual std::size_t count() const = 0;
  /// The frame in which the list is written, from that of copy `index`.
  virtual math::Transform at(std::size_t index) const = 0;
};

}  // namespace ifov::geometry
