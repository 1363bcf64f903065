#pragma once

#include <span>
#include <vector>

#include "sensor/detector/memory.h"

namespace ifov::session {

struct SignalSource;

/// The light that elements answer to in a channel's lines from `from` to before `to`: that of the image, or with what they remember of
/// exposures before, of each no more than fills a well.
class SeenLight {
 public:
  /// `memory` and `source` are kept.
  SeenLight(const SignalSource& source, const sensor::SignalMemory& memory, int channel, int from, int to,
            double most_radiance_w_m2_sr_um);

  /// Of one of the lines, W m-2 sr-1 um-1.
  void read(int line, std::span<float> radiance) const;

 private:
  void read_lines(int to);
  void read_frames(int line, std::span<float> radiance) const;

  const SignalSource& source_;
  const sensor::SignalMemory& memory_;
  int channel_, from_;
  double most_;
  std::vector<float> lines_;  // what scanners' lines show, where they remember
};

}  // namespace ifov::session
