#pragma once

#include <string>
#include <vector>

#include "studies/common/figures.h"
#include "studies/common/image_store.h"
#include "studies/common/study_options.h"
#include "studies/suburb/radiance_errors.h"

namespace ifov::io {
struct Document;
}

namespace ifov::studies {

/// A mean over seeds, and its standard error (NaN of one seed).
struct OverSeeds {
  double mean = 0.0, standard_error = 0.0;
};

/// One way of sampling, drawn with several seeds, against the RMS error of the grid 10 x 10 by channel.
struct CurvePoint {
  std::string name;
  double samples_per_px = 0.0;  ///< points asked of the scene
  double rays_per_px = 0.0;
  double seconds = 0.0;             ///< least of the seeds
  OverSeeds mean_band, worst_band;  ///< ErrorRatios::mean and worst
  OverSeeds tail_99, tail_999;      ///< error_quantile() of 0.99 and 0.999
  double stated_low = 0.0,
         stated_high = 0.0;  ///< stated over true RMS over the image, by channel; NaN where none is stated
  double coverage = 0.0;     ///< of half-widths; NaN without
};

/// Time over RMS error: grids, and the image's error as a whole at several limits, on the same paths. Limits are in shares of a noise that
/// is the RMS error of the grid 10 x 10 in each channel, and of the noise of an instrument.
struct ImageCurves {
  int seeds = 0;
  double reference_error = 0.0;         ///< about that of the reference's own, over that of the grid 10 x 10
  std::vector<CurvePoint> grids, ours;  ///< by falling error; `ours` by limits
  CurvePoint audited_grid, audited_ours;
  CurvePoint instrument;           ///< at the noise of MODIS; no seconds where it was left out
  double instrument_stated = 0.0;  ///< its stated RMS over that noise, in the channel where that is largest
  FigureTable figures;
};

/// `ten`: errors of the grid 10 x 10 against `reference`. `quick`: fewer settings, one seed.
ImageCurves image_curves(const io::Document& document, const ImageStore& reference, const RadianceErrors& ten,
                         const StudyOptions& options, bool quick);

/// Processor time at which a curve has an RMS error of 1: on the power between the two points about it, or, beyond the curve's ends, on
/// that of the two next to it.
double seconds_at_one(const std::vector<CurvePoint>& curve, OverSeeds CurvePoint::*error);

}  // namespace ifov::studies
