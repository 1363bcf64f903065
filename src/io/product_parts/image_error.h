#pragma once

namespace ifov::io {

/// How far a channel of an image is off as a whole, W m-2 sr-1 um-1.
struct ImageError {
  double mean = 0.0;     ///< the channel's
  double reached = 0.0;  ///< root mean square over the pixels
  double limit =
      0.0;  ///< of it, of what rays may leave; infinite where the channel is not judged, 0: none was asked for
  bool audited = false;  ///< measured, and not as samples tell it
};

}  // namespace ifov::io
