#pragma once

#include <cstddef>
#include <vector>

namespace ifov::studies {

class ImageStore;

/// What an image errs by in each channel, over the pixels that a reference holds.
struct RadianceErrors {
  std::vector<double> rms;   ///< W m-2 sr-1 um-1
  std::vector<double> mean;  ///< radiance of the reference, W m-2 sr-1 um-1
  double coverage = 0.0;     ///< share of intervals that hold the reference; NaN without intervals
};
/// Both images of the same scene; pixels of the reference without samples are left out.
RadianceErrors radiance_errors(const ImageStore& image, const ImageStore& reference);

/// Ratios of RMS errors to those of another image, over the channels that count for the latter: those that send more than a thousandth of
/// the brightest, where errors are more than rounding. Where the air is opaque they are roundings of its own radiance.
struct ErrorRatios {
  double mean = 0.0;     ///< root of the mean squared ratio
  double worst = 0.0;    ///< largest ratio
  double largest = 0.0;  ///< ratio of the largest RMS error of any channel to the other's largest
};
ErrorRatios error_ratios(const RadianceErrors& image, const RadianceErrors& other);
/// Whether a channel does.
bool counts(const RadianceErrors& image, std::size_t channel);

/// What |error| over the RMS error of another image stays below in a share of the pixels: the mean over the channels that count.
double error_quantile(const ImageStore& image, const ImageStore& reference, const RadianceErrors& other,
                      double share);

}  // namespace ifov::studies
