#pragma once

namespace ifov::sensor {

/// Which detector elements make which pixels of an image, and when one of them is exposed again.
struct ReadOut {
  /// An element for each pixel; elements across the track, exposed line by line; elements that sweep along lines.
  enum class Kind { frame, lines, sweeps };

  Kind kind = Kind::frame;
  int elements = 1;        ///< lines of a sweep
  bool backwards = false;  ///< sweeps run towards the first column
  bool both_ways = false;  ///< every second sweep runs the other way
  double period_s =
      0.0;  ///< from exposure to exposure of one element; 0: frames, of which the camera knows one

  /// The line whose elements see this line.
  int element_line(int line) const {
    switch (kind) {
      case Kind::frame: return line;
      case Kind::lines: return 0;
      case Kind::sweeps: return line % elements;
    }
    return line;
  }
  /// Whether the samples of this line are taken from the last column to the first.
  bool runs_backwards(int line) const {
    return kind == Kind::sweeps && backwards != (both_ways && line / elements % 2 == 1);
  }
};

}  // namespace ifov::sensor
