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

/// Fields of the light that goes on over those of the light that came, with the same axes: Born and Wolf, eq. 1.5.2 (20).
FresnelAmplitudes fresnel_transmission_amplitudes(std::complex<double> index, double cosine);

/// Two media with a film between them, whose reflections interfere (Born and Wolf, section 7.6.1).
struct FilmStack {
  std::complex<double> here = 1.0, film = 1.0, beyond = 1.0;  ///< refractive indices; light comes from `here`
  double waves = 0.0;  ///< thickness of the film over the wavelength in vacuum
};
/// What a boundary does with the power of light of either polarization.
struct PowerShares {
  double reflected_p = 0.0, reflected_s = 0.0, transmitted_p = 0.0, transmitted_s = 0.0;
};
/// `sine`: n times the sine of the direction, of the real index n of `here` or of what that borders on: the same in all media
/// (Snell). Amplitudes about the frames above; what is let through is counted beyond the film.
FresnelAmplitudes film_reflection_amplitudes(const FilmStack& stack, double sine);
FresnelAmplitudes film_transmission_amplitudes(const FilmStack& stack, double sine);
/// Power across the surface; nothing is let through where `here` or `beyond` has no travelling wave.
PowerShares film_shares(const FilmStack& stack, double sine);
/// n times the cosine of a ray in a medium, of the root that fades away: its imaginary part tells how fast.
std::complex<double> normal_index(std::complex<double> index, double sine);

/// Reflection by a smooth surface: what Mueller's matrix of these amplitudes is, about the frames above.
MuellerMatrix fresnel_reflection(std::complex<double> index, double cosine);
/// Transmission of power across the surface, so that reflection and transmission of unpolarized light add up
/// to 1; radiance, which is per solid angle, grows by index^2 besides. Zero beyond total reflection.
MuellerMatrix fresnel_transmission(double index, double cosine);

}  // namespace ifov::radiometry
