#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "io/document/document_values.h"

namespace ifov::io {

/// One ray through the centre of each pixel.
struct SingleSampling {};

/// Rays through the centres of columns x rows equal cells of each pixel.
struct GridSampling {
  int columns = 1, rows = 1;
};

/// A size of error or difference, in the unit the user thinks in.
struct ErrorSize {
  enum class Unit {
    kelvin,       ///< brightness temperature of a channel
    radiance,     ///< W m-2 sr-1 um-1
    fraction,     ///< of the pixel's own value (1 % is 0.01)
    reflectance,  ///< apparent reflectance
    noise,        ///< the noise that each channel of the sensor declares
  };
  double value = 0.0;  ///< above zero
  Unit unit = Unit::fraction;
};

/// Sub-elements that differ get more samples.
struct AdaptiveSampling {
  int sub_columns = 1, sub_rows = 1;
  ErrorSize allowed_difference;         ///< radiance or fraction
  int max_samples = 100;                ///< per pixel
  std::optional<DocumentName> channel;  ///< that is compared; absent: all, the largest difference counts
  SourcePosition position;
};

/// Samples until the half-width of every judged interval is within `error`.
struct AccuracySampling {
  ErrorSize error{0.01, ErrorSize::Unit::fraction};
  std::optional<DocumentName> channel;  ///< that is judged; absent: all channels
  double confidence = 0.95;
  bool simultaneous = false;    ///< confidence for all channels of a pixel at once
  std::optional<int> lattice;   ///< detection lattice cells per pixel side; absent: the sampler's choice
  int probes = 9;               ///< probing rays a flagged pixel and round
  bool seeds = true;            ///< one ray per known object smaller than a pixel
  double thinnest_px = 0.0125;  ///< thinnest feature that is tracked
  std::int64_t max_samples = 100000;  ///< per pixel
  double floor = 0.001;  ///< of a white Lambertian surface's radiance: no limit in percent is lower, and in K
                         ///< no pixel is taken to be colder than that radiance
  bool clutter = true;   ///< switch to nested stratified samples where edges are too many
  SourcePosition position;
};

struct SamplingDocument {
  std::variant<SingleSampling, GridSampling, AdaptiveSampling, AccuracySampling> method = AccuracySampling{};
  int tile_px = 64;
  int mirror_reflections = 8;    ///< flat mirrors in turn by way of which sunlight is sought
  std::optional<int> max_depth;  ///< surfaces a path may meet; absent: no limit, ended without bias
  SourcePosition position;
};

}  // namespace ifov::io
