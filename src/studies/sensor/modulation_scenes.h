#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/document/sensor_document.h"
#include "studies/sensor/slanted_edge.h"

namespace ifov::studies {

inline constexpr double kEdgeAngle_deg = 5.0;

/// Optics of a frame camera: what of a Gaussian, an aperture whose diffraction is q = wavelength times f-number over pitch, diffusion through
/// a layer without a field and crosstalk to each neighbour is not 0, convolved.
struct EdgeOptics {
  double gaussian_px = 0.0, airy_q_px = 0.0;
  double obscuration = 0.0;  ///< of the aperture's middle, diameter over diameter
  double field_free_px = 0.0, crosstalk = 0.0;
};
/// A black edge of 300 K against cold ground, 5 degrees from upright, rendered.
EdgeResponse still_edge(const EdgeOptics& optics, const StudyOptions& options, int pixels = 64);
/// The same across the track of a scanner whose pixels are as long as wide and which is exposed all the time, or of so many stages at a
/// speed that is faster than its lines by a share. Modulation along the track.
EdgeResponse scanned_edge(double element_length_px, int stages, double mismatch, const StudyOptions& options,
                          int pixels = 64);

/// What of them the product of its parts is, at a frequency across the edge.
double still_modulation(const EdgeOptics& optics, double cycles_px);
double scanned_modulation(double element_length_px, int stages, double mismatch, double cycles_px);
/// Largest difference up to Nyquist's frequency.
double edge_difference(const EdgeResponse& found, const std::function<double(double)>& expected);

/// A small hot disc somewhere in the middle pixel of a cold image: its share of light in each of 11 x 11 pixels, and what of the PSF's energy
/// falls on them.
struct PointShares {
  static constexpr int kPixels = 11;
  std::vector<double> distance_px, found, expected;
  double largest = 0.0;  ///< difference, of pixels up to 4 away
};
PointShares point_shares(const EdgeOptics& optics, double x_px, double y_px, const StudyOptions& options);

/// Energy of an open aperture's diffraction on a square of one pixel about (x, y), by quadrature of the Airy pattern.
double airy_energy(double q_px, double x_px, double y_px);

/// The optics of a document's sensor.
void set_optics(const EdgeOptics& optics, io::SensorDocument& sensor);

}  // namespace ifov::studies
