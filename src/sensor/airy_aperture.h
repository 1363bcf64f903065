#pragma once

namespace ifov::sensor {

/// Diffraction at a circular aperture: h(r) = (pi / 4 q^2) [2 J1(v) / v]^2, v = pi r / q, with
/// q = wavelength * focal length / (diameter * pitch) in pixels (Born & Wolf, Principles of Optics, 8.5.2). Where its middle is
/// covered to the share e of its diameter, h(r) = (pi / 4 q^2) [2 J1(v) / v - e^2 2 J1(e v) / (e v)]^2 / (1 - e^2) (8.6.2).
/// The energy within a radius is, of an open one, E(v) = 1 - J0(v)^2 - J1(v)^2; 1 - E falls only as 2 / (pi v (1 - e)).
struct AiryAperture {
  double wavelength_um = 0.0;
  double diameter_m = 0.0;
  double focal_length_m = 0.0;
  double pitch_m = 0.0;
  double obscuration = 0.0;  ///< diameter over diameter, 0 to 0.95
};

}  // namespace ifov::sensor
