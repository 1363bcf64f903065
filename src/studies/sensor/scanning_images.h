#pragma once

#include <vector>

#include "studies/sensor/sensor_rendering.h"

namespace ifov::studies {

/// Bright discs on darker ground under an even sky, as a scanner sees them.
/// Rendered at 1 %.
SensorImage scan_discs(const ScannerFlight& flight, const StudyOptions& options);
/// The same ground by parallel rays, in the pixels of a flight at the speed of its lines.
SensorImage discs_from_above(const ScannerFlight& flight, const StudyOptions& options);
/// What geometry says of that flight's image: the mean of cells x cells points a pixel.
std::vector<double> discs_by_geometry(const ScannerFlight& flight, int cells);

/// How an image keeps to its intervals.
struct HeldShares {
  double all = 0.0, edges = 0.0;  ///< of pixels, and of those that hold an edge of a disc
  double worst = 0.0;             ///< largest departure beyond the half-width, as a share of the contrast
};
HeldShares held_shares(const SensorImage& image, const std::vector<double>& truth);
/// The same of two images, each with its interval; edges as `truth` has them.
HeldShares held_shares(const SensorImage& one, const SensorImage& other, const std::vector<double>& truth);

}  // namespace ifov::studies
