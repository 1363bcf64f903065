#pragma once

#include <vector>

#include "studies/sensor/slanted_edge.h"

/// Scenes whose channels have footprints of their own, in one run.
namespace ifov::studies {

/// An aperture whose diffraction at a wavelength is that many pixels (wavelength times f-number over pitch). `one_footprint`: all
/// channels have that of the first wavelength, a planted fault.
struct ChannelOptics {
  double q_px_um = 1.0;  ///< pixels, per um of wavelength
  double fill_factor = 1.0;
  bool one_footprint = false;
};

/// Slanted edges in 0.45 and 2.2 um of one image, four times as wide as high.
struct ChannelEdges {
  std::vector<double> wavelength_um;
  std::vector<EdgeResponse> edges;
  std::vector<double> mtf50_cycles_px;  ///< of the optics: what the square damps is divided out
  double ratio() const { return mtf50_cycles_px.front() / mtf50_cycles_px.back(); }
};
ChannelEdges channel_edges(const ChannelOptics& optics, const StudyOptions& options, int width_px);

/// What a sensitive square damps of a frequency across such an edge.
double square_across(const ChannelOptics& optics, double cycles_px);

/// Light of a small hot disc in pixels up to 4 away, in 4, 7 and 11 um of one image, against the energy of each channel's Airy pattern:
/// the largest difference of a share, by channel.
std::vector<double> channel_points_off(const ChannelOptics& optics, double x_px, double y_px,
                                       const StudyOptions& options);

}  // namespace ifov::studies
