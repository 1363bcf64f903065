#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "studies/common/figures.h"
#include "studies/common/image_store.h"
#include "studies/common/material_counts.h"
#include "studies/common/study_options.h"
#include "studies/suburb/image_curves.h"
#include "studies/suburb/radiance_errors.h"

namespace ifov::studies {

/// One way of sampling the scene, and what came of it.
struct SceneResult {
  std::string name, sampling;
  std::unique_ptr<ImageStore> image;
  double seconds = 0.0;
  double samples_per_px = 0.0;
  std::uint32_t fewest_samples = 0, most_samples = 0;
  RadianceErrors errors;  ///< against the reference, where there is one
  ErrorRatios over_grid;  ///< to those of the grid 10 x 10
  MaterialCounts materials;
  AbundanceErrors abundances;
};

/// What the adaptive scheme compares: the channel, and the difference that it allows as a share of the average.
struct AdaptiveRule {
  std::size_t channel = 0;
  double allowed_difference = 0.0;
};

/// What two rays through one point stay within in 95 % of pixels in a channel, as a share of the radiance, to two figures:
/// the noise of their paths. `one` and `other` are radiances of one ray a pixel with different random numbers, `columns`
/// to a pixel.
double path_noise(std::span<const float> one, std::span<const float> other, std::size_t channel, int columns);

struct SceneResults {
  std::vector<SceneResult> results;  ///< one ray, grid 5, grid 10, adaptive, then accuracy
  std::size_t chosen = 0;  ///< the accuracy setting that is judged: no worse than the grid in any channel
  std::size_t chosen_by_largest = 0;  ///< the one whose largest error is no larger than the grid's largest
  std::vector<double> wavelengths_um;
  std::vector<std::string> materials;
  AdaptiveRule adaptive;
  std::string lighting;           ///< what shines on the scene and how warm it is, in words
  double reference_pixels = 0.0;  ///< share of the pixels whose radiance is known from the reference
  ImageCurves curves;
  FigureTable figures;
};

/// The paper's third study: sub-pixel content of a hyperspectral image of a residential area.
StudyOutcome run_suburb_study(const StudyOptions& options);

}  // namespace ifov::studies
