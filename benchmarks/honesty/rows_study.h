#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/rows_scene.h"

namespace ifov::benchmarks {

struct RowsStudy {
  int steps = 400;               ///< scenes of each form, pitches of 0.2 to 40 px between them
  std::uint64_t first_seed = 1;  ///< chooses the scenes, and seeds their renderings
  std::filesystem::path work = ".";
  std::filesystem::path rows;  ///< CSV file of all pixels; empty: none
  int threads = 0;
};

/// How the pixels of one form compare with exact areas; shares are of all pixels but where said.
struct RowsOutcome {
  RowsScene::Form form{};
  std::int64_t pixels = 0;
  double outside = 0.0;  ///< off by more than their half-width
  double converged = 0.0;
  double outside_converged = 0.0;  ///< of the converged: off by more than their half-width
  double lies = 0.0;               ///< of the converged: off by more than 5 half-widths
  double worst_z = 0.0;            ///< of the converged; infinite where an error of 0 was claimed
  double rays = 0.0;               ///< per pixel
  int poor_scenes = 0;             ///< fewer than 0.9 of the converged hold the truth
  struct Scene {
    std::string document, description;
    double outside = 0.0, worst_z = 0.0;
  };
  std::vector<Scene> worst;  ///< up to ten
};

/// Rows in step with the pixels and out of it (rows_at_random), each scene rendered once as a document of default
/// accuracy; every pixel is judged against its exact area shares. Errors below 1e-5 of the value, the precision of
/// products, are none.
std::vector<RowsOutcome> run_rows_study(const RowsStudy& study);

}  // namespace ifov::benchmarks
