#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/product_parts/image_error.h"
#include "io/product_parts/run_identity.h"
#include "render/image_info.h"
#include "sampling/field.h"
#include "sampling/reason_words.h"

namespace ifov::io {

/// What is known after the last tile.
struct RunOutcome {
  std::string accuracy_statement;   ///< plain words: what was asked for, what was reached, where it was not
  std::string detection_statement;  ///< plain words: what could have been missed, with what probability
  std::vector<std::string> notes;   ///< floors, warnings
  double elapsed_s = 0.0;
  int threads = 0;                            ///< 0: all cores, whose number is then recorded
  std::string date;                           ///< when the products were made, UTC, ISO 8601
  std::vector<ImageError> image_errors = {};  ///< by channel; empty where pixels are judged one by one
};

/// What a mean half-width is made of, at the mean radiance.
struct HalfWidthParts {
  double sampling = 0.0;  ///< rays and what they cannot tell
  double air = 0.0;       ///< how the air was computed
  double model = 0.0;     ///< the model of the air, where the interval holds its error
  double nodes = 0.0;     ///< few spectral nodes for a channel
};

/// Figures of one channel over the image. Values that are not finite are left out and counted.
struct ChannelStatistics {
  double minimum = 0.0, maximum = 0.0, mean = 0.0, standard_deviation = 0.0;
  double mean_half_width = 0.0, largest_half_width = 0.0;
  std::optional<HalfWidthParts> parts;  ///< under a modelled atmosphere
  std::uint64_t not_finite = 0;
};

/// Figures of the whole image, gathered from its tiles.
struct ImageStatistics {
  std::vector<ChannelStatistics> channels;
  std::uint64_t pixels = 0, converged = 0;
  sampling::ReasonCounts reasons{};  ///< pixels that are not converged, by reason; one may have several
  std::uint64_t samples = 0, label_rays = 0, radiance_evaluations = 0;
  std::uint64_t halo_samples = 0, pilot_samples = 0, probe_samples = 0;
  std::uint32_t fewest_samples = 0, most_samples = 0;
  double worst_ratio = 0.0;  ///< largest half-width over its limit
  double largest_missable_fraction = 0.0;
  sampling::RayCounts rays;
};

struct ProductFile {
  std::filesystem::path path;
  std::string what;  ///< one line for the user: "radiance, 210 channels, ENVI"
  std::uint64_t bytes = 0;
  std::string sha256;
};

struct RunRecord {
  RunIdentity identity;
  RunOutcome outcome;
  render::ImageInfo image;
  ImageStatistics statistics;
  std::vector<ProductFile> files;
  std::string interleave = "bil";  ///< of the cubes, as headers say it
};

}  // namespace ifov::io
