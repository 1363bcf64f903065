#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/run_control.h"

namespace ifov {

struct DetectOptions {
  std::filesystem::path folder;  ///< of the cubes that are made; empty: that of the run
  std::uint64_t first_seed = 1;  ///< the same seed gives the same noise
  int realizations = 1;          ///< each with a seed one higher than the one before
  std::optional<Document>
      other;        ///< whose channels tell the noise; without it, the noise that the run's record tells
  int threads = 0;  ///< 0: all cores; the bytes do not depend on it
  const CancelToken* cancel = nullptr;
};

/// What was made of a run's radiance.
struct Detection {
  struct Channel {
    std::string name;
    double noise = 0.0;  ///< its standard deviation, W m-2 sr-1 um-1; 0: none
  };
  std::vector<Channel> channels;
  std::vector<std::filesystem::path> cubes;  ///< NAME_noisy_SEED.img, one a realization
};

/// Adds what the sensor's noise makes of it to the radiance of a finished run, without a ray: normal, independent from pixel to
/// pixel and channel to channel, of the standard deviation that channels tell ("noise", "noise_temperature"). `run`: a
/// folder with one run record, or the record. Throws InputError, located, where no channel tells any or channels are not those of
/// the run; SystemError for files; Cancelled.
IFOV_API Detection detect(const std::filesystem::path& run, const DetectOptions& options);

}  // namespace ifov
