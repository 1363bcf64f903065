#pragma once

#include <span>
#include <vector>

namespace ifov::analysis {

/// An image cube in memory: pixels row by row, the columns (channels) of a pixel side by side.
struct CubeView {
  std::span<const float> values;
  int width = 0, height = 0, columns = 0;
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// Directions in spectral space, best first, onto which the spectra of an image are projected.
struct SpectralAxes {
  std::vector<double> mean;     ///< columns
  std::vector<double> weights;  ///< axis by axis, columns each: score = weights . (spectrum - mean)
  /// Of each axis: the variance along it (principal components), or the ratio of variance to noise variance
  /// (minimum noise fraction).
  std::vector<double> strength;
  int columns = 0;
  int count() const { return static_cast<int>(strength.size()); }
};

/// Principal components: eigenvectors of the covariance of all spectra (Hotelling 1933), largest variance first.
SpectralAxes principal_axes(const CubeView& cube, int count);

/// Minimum noise fraction transform (Green, Berman, Switzer and Craig 1988, IEEE TGRS 26, 65): solves
/// S w = l N w for the covariance S of the image and N of its noise, largest l first. As usual where the noise is not
/// known, N is half the covariance of differences of neighbours (mean of the shifts to the right and down); what
/// differs from pixel to pixel counts as noise. N is stiffened by a billionth of its mean variance, so that
/// channels that add nothing do not make it singular. At least 2 x 2 pixels.
SpectralAxes minimum_noise_axes(const CubeView& cube, int count);

/// The same where the noise is known: `noise_variance` of each channel, as the mean over the image of the squared standard errors.
/// Errors of two channels count as independent, which those of one pixel's paths are not quite: N is diagonal. Strengths are
/// ratios of variances, so that a channel that is all noise has 1. Throws std::invalid_argument where there are not as many
/// variances as channels, or none is above 0.
SpectralAxes minimum_noise_axes(const CubeView& cube, std::span<const double> noise_variance, int count);

/// Scores of every pixel on every axis, pixel by pixel.
std::vector<float> project(const SpectralAxes& axes, const CubeView& cube);

}  // namespace ifov::analysis
