#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "honesty/interval_statistics.h"
#include "sampling/accuracy/accuracy_sampler.h"

namespace ifov::io {
struct Document;
}

namespace ifov::benchmarks {

template <class Sampler>
std::unique_ptr<sampling::PixelSampler> make_sampler(const sampling::AccuracyOptions& options) {
  return std::make_unique<Sampler>(options);
}

/// A document of benchmarks/honesty/scenes by its file name without .json; `work` holds the files that it names.
io::Document read_scene(const std::string& scene, const std::filesystem::path& work);

/// One run of a scene of benchmarks/honesty/scenes.
struct HonestyCase {
  std::string scene;      ///< file name without .json
  bool psf = false;       ///< a Gaussian PSF of 0.6 pixels
  bool sun_state = true;  ///< false: a planted fault, labels without the Sun's state
  /// Makes the sampler that is judged: the real one, or one with a planted fault (faulty_samplers.h).
  std::unique_ptr<sampling::PixelSampler> (*sampler)(const sampling::AccuracyOptions&) =
      make_sampler<sampling::AccuracySampler>;
  int seeds = 24;
  std::uint64_t first_seed = 5000;
  std::filesystem::path rows;  ///< file that takes every judged pixel, seed and channel as CSV; empty: none
  bool stokes = false;         ///< I, Q and U are judged
  bool groups = false;         ///< a Gaussian PSF that stands elsewhere in each channel
  bool unshifted = false;      ///< a planted fault: of groups, the reference knows no shifts
};

struct HonestyOutcome {
  std::vector<std::string> channels;
  std::vector<ChannelHonesty> honesty;  ///< by channel; with Stokes by those of I, of Q and of U
  std::size_t pixels = 0;               ///< judged
  double samples_per_pixel = 0.0;
  double paths_per_pixel = 0.0;
};

/// Renders the scene with every seed and compares each of its mixed pixels with the plain reference. Mixed
/// pixels are the 64 whose radiance differs most from path to path in a small plain rendering of its own
/// seed, so they are fixed before the sampler looks; pixels that do not differ by 1 % are left out. `work`
/// holds the files that scenes name.
HonestyOutcome run_case(const HonestyCase& which, const std::filesystem::path& work);

/// Writes the mesh and the temperature map that scenes name.
void write_scene_files(const std::filesystem::path& work);

}  // namespace ifov::benchmarks
