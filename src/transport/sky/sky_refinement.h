#pragma once

#include <vector>

#include "radiometry/spectrum_block.h"

namespace ifov::transport {

/// A table of the sky by direction, azimuths from the Sun's from 0 to pi, row by row of azimuths.
struct SkyGrid {
  std::vector<double> zenith_rad, azimuth_rad;
};

/// Every step of the table as kSkyRefinement of equal width.
inline constexpr int kSkyRefinement = 4;
SkyGrid refined(const SkyGrid& grid);

/// Rows of `spectra` at refined directions, by cubic polynomials through the four nearest in zenith angle and then in azimuth, about
/// whose ends the sky is symmetric, with this sign (U: -1). No value lies outside its two neighbours by more than a quarter
/// of the smaller second difference, and none where these differ in sign: about the Sun, where the sky is a peak, it does not ring.
radiometry::SpectrumBlock refined(const SkyGrid& grid, const radiometry::SpectrumBlock& spectra, float sign);

}  // namespace ifov::transport
