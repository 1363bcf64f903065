#pragma once

#include <vector>

#include "studies/sensor/sensor_rendering.h"

namespace ifov::studies {

/// The modulation that the image of a slanted edge shows.
struct EdgeResponse {
  double slope = 0.0;                           ///< of the edge, pixels across in a row
  std::vector<double> cycles_px, modulation;    ///< across the edge
  double at(double frequency_cycles_px) const;  ///< linear between these
};

/// e-SFR of ISO 12233: rows' derivatives, their centroids (again within a window about the first fit), a line (or, `order` 5, a
/// polynomial as the edition of 2023 has it) through them, all values in bins of a quarter of a pixel by their distance from it, the derivative of these, a
/// window (Hamming; Tukey in 2023), the Fourier transform, over what the derivative by differences damps. The edge is nearly upright, and
/// moves by a whole number of pixels over the rows that are taken. The standard leaves in what the mean over a bin damps, a sinc that is
/// 0.974 at Nyquist's frequency.
struct EdgeChoices {
  int order = 1;
  bool tukey = false;
  bool divide_bins = true;         ///< out of the modulation
  double highest_cycles_px = 0.5;  ///< below 2, where the bins see nothing
};
EdgeResponse edge_response(const SensorImage& image, const EdgeChoices& choices = {});

}  // namespace ifov::studies
