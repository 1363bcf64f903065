#pragma once

namespace ifov::geometry {

/// Seconds after the document's instant.
struct TimeInterval {
  double from_s = 0.0, to_s = 0.0;
};

}  // namespace ifov::geometry
