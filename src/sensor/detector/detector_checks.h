#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sensor/detector/detector.h"

/// What a laboratory measures of a detector, from nothing but its signals and counts. Electrons where nothing else is said.
namespace ifov::sensor {

struct Moments {
  double mean = 0.0, variance = 0.0;  ///< the variance with n - 1
};
Moments moments(std::span<const double> values);

/// Signals of an evenly lit image, [line][column].
struct SignalImage {
  int lines = 0, columns = 0;
  std::vector<double> values;
};
/// As DetectorSignal draws it for channel 0, of this radiance everywhere.
SignalImage signal_image(const Detector& detector, double radiance_w_m2_sr_um, int lines, int columns,
                         std::uint64_t seed = 1);

/// Standard deviations of what elements, rows and columns have of their own: analysis of variance with two factors.
struct PatternSpreads {
  double pixel = 0.0, row = 0.0, column = 0.0;
};
PatternSpreads pattern_spreads(const SignalImage& image);

/// Photon transfer (Janesick 2007: Photon Transfer) of 400,000 counts at each of several mean signals from 8 electrons up by half
/// decades, to 0.9 of the full well: what is above darkness, in counts, and the line through the logarithms of its variance and mean.
struct PhotonTransfer {
  std::vector<double> mean, variance;  ///< counts, counts^2; less those in darkness
  Moments darkness;                    ///< counts
  double slope = 0.0;
  double gain = 0.0;  ///< electrons a count: mean over variance
};
/// `altered`: what is done to a count before it is looked at; none: nothing.
PhotonTransfer photon_transfer(const Detector& detector,
                               const std::function<double(double count)>& altered = {});

/// Power of the columns of a series ([line][column]) at k / lines cycles a line, k below half the lines, under a Hann window: mean over
/// columns, as a two-sided density (units^2 per cycle a line). Lines: a power of two.
std::vector<double> column_spectrum(std::span<const float> series, int lines);

}  // namespace ifov::sensor
