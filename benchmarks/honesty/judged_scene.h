#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/wild_scene.h"

namespace ifov::benchmarks {

/// How a scene is judged.
struct Judging {
  int seeds = 3;
  std::uint64_t first_seed = 1;
  int pixels = 24;  ///< half at random, half those whose radiance scatters most in a few plain paths; 0: all
  double most_paths = 2e6,
         most_photons = 3e7;  ///< of the reference: a pixel, and an image for each pixel's ball
  double boast = 1.0;  ///< a planted fault: intervals and sigmas are taken to be this times what they are
  std::filesystem::path rows;  ///< CSV file of every judged value; empty: none
};

/// Counts of values (pixels times channels times seeds).
struct JudgedScene {
  std::string kind, name;
  std::int64_t values = 0;    ///< judged
  std::int64_t left_out = 0;  ///< the reference is not known to a third of the half-width; besides `values`
  std::int64_t honest = 0;    ///< not converged, and says so
  std::int64_t wrong_unsure = 0;  ///< of the honest: off by more than their half-width
  std::int64_t right = 0;         ///< converged, the truth within the half-width and two reference errors
  std::int64_t lies = 0;     ///< converged, off by more than 5 half-widths and clear of the reference's error
  std::int64_t far = 0;      ///< converged, |z| > 4
  double worst_z = 0.0;      ///< of the converged; infinite where no error was claimed
  double worst_ratio = 0.0;  ///< of the converged: largest error over the half-width
  double reference = 0.0;    ///< mean over the converged of the reference's error over the half-width
  double rays = 0.0;         ///< per pixel of the image
  std::string worst;         ///< the worst converged value in words
  bool exact = false;        ///< against a closed form

  std::int64_t converged() const { return values - honest; }
  double coverage() const {
    return converged() > 0 ? static_cast<double>(right) / static_cast<double>(converged()) : 1.0;
  }
};

/// Renders the scene with every seed by what its document asks for and judges pixels that are chosen beforehand
/// against the closed form or the plain tracer. Where a value looks like a lie the pixel's reference is worked out
/// again, from other random numbers and four times the paths, and that counts. Errors below 1e-5 of the value, the
/// precision of products, are none; references need not be better known than 0.1 % of it.
JudgedScene judge_scene(const WildScene& scene, const std::filesystem::path& folder, const Judging& judging);

/// One line of figures.
std::string summary(const JudgedScene& scene);

}  // namespace ifov::benchmarks
