#pragma once

#include <vector>

#include "core/error.h"
#include "geodesy/utc_time.h"

namespace ifov::io {

/// When an object is there.
struct PresenceDocument {
  struct Interval {
    geodesy::UtcTime begin, end;
  };
  std::vector<Interval> intervals;  ///< in order, apart from each other; one or more
  SourcePosition position;
};

}  // namespace ifov::io
