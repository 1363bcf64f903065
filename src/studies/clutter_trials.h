#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/clutter_scene.h"
#include "studies/common/figures.h"
#include "studies/common/study_options.h"

namespace ifov::studies {

/// A clutter image against its truth, over pixels far enough from the rim for the PSF.
struct ClutterResult {
  std::string what;
  double rms_c = 0.0, coverage = 0.0;
  double samples_per_px = 0.0;  ///< halo included
  double render_s = 0.0;
};

/// Rays per pixel at an RMS error, between the two results on either side of it, by logarithms; infinite
/// where none is as good, the fewest rays tried where all are.
double rays_at_rms(std::vector<ClutterResult> results, double rms_c);

/// The rows of clutter: PSF of 0.6 px by accuracy and by shared grid rays, dense clutter with and without the
/// switch to stratified samples, same bytes for any threads and tile order, tiles of 16 and 64.
struct ClutterStudy {
  std::vector<ClutterResult> psf_model, psf_drawn, psf_grid, dense_switched, dense_traced;
  bool same_bytes = false;
  double tiles_agree = 0.0;  ///< share of pixels whose intervals overlap between tiles of 16 and 64 px
  double seam_ratio = 0.0;   ///< RMS error of pixels at the tiles' rims over that of the others (tiles of 16)
};
ClutterStudy run_clutter(const std::filesystem::path& folder, const StudyOptions& options);

void add_clutter_figures(const ClutterStudy& study, FigureTable& figures);
std::string clutter_html(const ClutterStudy& study);

}  // namespace ifov::studies
