#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/figure_row.h"

namespace ifov::benchmarks {

/// A scene of benchmarks/honesty/scenes as an image whose error as a whole is asked for ("of": "image") and audited: 36 x 36 pixels of half the
/// size.
struct ImageCase {
  std::string scene;
  int seeds = 12;
  std::uint64_t first_seed = 5000;
  int audited = 200;
  /// A planted fault: what of the differences of like pixels is believed (ImageSampler::Pooling::trust); 1: none.
  double trust = 1.0;
};

struct ImageOutcome {
  struct Channel {
    std::string name;
    /// Shares of half-widths that hold the reference: of pixels of one material, of others (NaN where there are too few to tell), of all.
    std::array<double, 2> of_class{};
    double coverage = 0.0;
    double unaudited = 0.0;       ///< share of 1.96 stated standard deviations that would
    double stated_to_true = 0.0;  ///< RMS error over the image
    double exact = 0.0;           ///< share of the pixels whose error is below the precision of products
  };
  std::vector<Channel> channels;
  double samples_per_pixel = 0.0;
};

/// Renders with every seed and compares pixels that were drawn evenly beforehand with the plain reference.
ImageOutcome run_image_case(const ImageCase& which, const std::filesystem::path& work);

/// All scenes, and the planted fault; prints as it goes. `only`: one scene, or 'fault'; empty: all.
std::vector<FigureRow> report_images(const std::string& only, int seeds, std::uint64_t first_seed,
                                     const std::filesystem::path& work);

}  // namespace ifov::benchmarks
