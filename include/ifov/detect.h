#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ifov/document.h"
#include "ifov/run_control.h"

namespace ifov {

/// What a detector's signal is told as.
enum class DetectedQuantity {
  radiance,  ///< W m-2 sr-1 um-1, float: as one who knows the mean response makes it of counts, or of the signal where none are made
  electrons,  ///< float: the signal before it is digitised
  counts,  ///< 16 or 32 bits without a sign; the header's "data gain values" and "data offset values" make radiance of them
  kelvins,  ///< float: brightness temperatures of that radiance, by the channels' responses; not a number without light
  toa_reflectance,  ///< float: that radiance over the Sun's light on a level surface above the air, as the run's record tells it
};

struct DetectOptions {
  std::filesystem::path folder;  ///< of the cubes that are made; empty: that of the run
  std::uint64_t first_seed = 1;  ///< the same seed gives the same noise
  int realizations = 1;          ///< each with a seed one higher than the one before
  std::vector<DetectedQuantity> quantities = {DetectedQuantity::radiance};
  /// Whose channels tell the noise; without it, what the run's record tells.
  std::optional<Document> other;
  /// Values in place of the document's that the record holds, as Document::read takes them; not beside `other`.
  std::vector<std::string> set;
  int threads = 0;  ///< 0: all cores; the bytes do not depend on it
  const CancelToken* cancel = nullptr;
  /// Of a sensor with a mosaic of filters: what each element has through its own filter alone, as one band.
  bool mosaic = false;
  /// Runs of the frames before, the last one first, for detectors with a lag or a time constant: what of their light is still there. Without
  /// them frames before were like this one. Of frame cameras; scanners remember their own lines and samples.
  std::vector<std::filesystem::path> after = {};
};

/// What was made of a run's radiance.
struct Detection {
  struct Channel {
    std::string name;
    double noise = 0.0;  ///< standard deviation, W m-2 sr-1 um-1, with a detector at its reference; 0: none
    bool has_detector = false;
    double saturated = 0.0;  ///< share of pixels, of all realizations
  };
  std::vector<Channel> channels;
  std::vector<std::filesystem::path>
      cubes;  ///< NAME_noisy_SEED.img, NAME_electrons_SEED.img, NAME_counts_SEED.img, ...; NAME_mosaic_counts_SEED.img
};

/// Draws what the sensor makes of the radiance of a finished run, without a ray: with a detector's physics where channels have one
/// ("detector"), else normal noise, independent from pixel to pixel and channel to channel, of the standard deviation that channels
/// state ("noise", "noise_temperature", "snr"). `run`: a folder with one run record, or the record. Throws InputError, located, where
/// no channel tells any noise, electrons or counts are asked for that a channel does not make, or channels are not those of the run;
/// SystemError for files; Cancelled.
IFOV_API Detection detect(const std::filesystem::path& run, const DetectOptions& options);

}  // namespace ifov
