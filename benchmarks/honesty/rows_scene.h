#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "honesty/random_stream.h"

namespace ifov::benchmarks {

/// Straight rows of one surface on another, seen straight down; what each pixel sees is known exactly.
struct RowsScene {
  enum class Form { map, boxes, mesh };

  Form form = Form::map;
  double pitch_m = 1.0;
  double duty = 0.5;        ///< share of the pitch that a row covers
  double phase_m = 0.0;     ///< where a row begins, along the axis across the rows
  bool across_east = true;  ///< rows follow each other to the east (and run north), or to the north
  double angle_deg = 0.0;   ///< of the image against the rows
  double gsd_m = 1.0;
  double centre_m[2] = {0.0, 0.0};
  int size_px = 12;
  bool lit = true;  ///< level surfaces under Sun and sky; else black ones at two temperatures
  double row = 0.05, between = 0.3;  ///< reflectances, or temperatures in kelvins
  double height_m = 0.0;             ///< of rows over what lies between them (black surfaces only)
  bool tiled = false;                ///< a map of one pitch that repeats, instead of one that is written out
  double psf_sigma_px = 0.0;         ///< of a Gaussian PSF; 0: none

  /// The document. A map or mesh is written to `folder` under names that begin with `name`.
  std::string write(const std::filesystem::path& folder, const std::string& name) const;

  /// Share of the rows in each pixel, row by row: the integral of the pixel's square, blurred by the whole (not cut)
  /// Gaussian where there is one, over the strips. Closed form.
  std::vector<double> shares() const;

  /// Radiance of each pixel in the document's one channel, W m-2 sr-1 um-1.
  std::vector<double> radiance() const;

  std::string description() const;  ///< one line
};

const char* name_of(RowsScene::Form form);

/// Rows of about the given pitch, everything else by chance: half of them in simple ratios to the GSD, a third
/// exactly along the pixels and a third nearly so, half of them beginning at the middle of the image, if that has not
/// been moved a border of pixels.
RowsScene rows_at_random(RowsScene::Form form, double pitch_px, RandomStream& random);

}  // namespace ifov::benchmarks
