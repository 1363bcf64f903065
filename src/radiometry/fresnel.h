#pragma once

#include <complex>

#include "radiometry/mueller.h"

namespace ifov::radiometry {

/// Amplitudes of a plane wave at a smooth surface, along x (in the plane of incidence, p) and y (across it, s)
/// of frames with one common y, along direction cross normal, and x = y cross direction for light before, after
/// reflection and after transmission: scattering_frames(). At normal incidence x of reflected light points the
/// other way, so that there p = -s. Formulas and signs as Born and Wolf (1999), section 1.5.2.
struct FresnelAmplitudes {
  std::complex<double> p, s;
};

/// `index`: refractive index of the far side over that of the near one, n + ik, k >= 0 where it absorbs; below
/// 1 light is reflected totally beyond arcsin n. `cosine`: of the angle of incidence, 0 to 1.
FresnelAmplitudes fresnel_reflection_amplitudes(std::complex<double> index, double cosine);

/// Reflection by a smooth surface: what Mueller's matrix of these amplitudes is, about the frames above.
MuellerMatrix fresnel_reflection(std::complex<double> index, double cosine);
/// Transmission of power across the surface, so that reflection and transmission of unpolarized light add up
/// to 1; radiance, which is per solid angle, grows by index^2 besides. Zero beyond total reflection.
MuellerMatrix fresnel_transmission(double index, double cosine);

}  // namespace ifov::radiometry
