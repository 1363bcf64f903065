#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "materials/bsdf/microfacet/row_weights.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// Fresnel reflectance of unpolarized light as spectra at a few angles, between which it is cubic: what is linear in these is
/// exact in the mean over a channel, as reflectance is, while that of a mean index is not.
///
/// The angles are cos = (k / 32)^3. Between them it is within 2e-5 for indices of glass and of metals in visible light, 2e-4 at
/// index 10 + 60i; beside the angle of total reflection of an index below 1 that hardly absorbs, up to 0.1 within a degree.
struct FresnelRows {
  static constexpr std::size_t kCount = 33;

  static double cosine(std::size_t row);
  /// n + ik, with k >= 0, at the wavelengths of both and as many more as the reflectance needs to be linear between
  /// them within 2e-4.
  static std::vector<radiometry::Spectrum> of_index(const radiometry::Spectrum& n,
                                                    const radiometry::Spectrum& k);

  /// The rest of Fresnel's matrix at the same angles: kCount rows of (|r_p|^2 - |r_s|^2) / 2, of Re(r_p r_s*) and of
  /// Im(r_p r_s*), each as near as the reflectance.
  static std::vector<radiometry::Spectrum> polarization_of_index(const radiometry::Spectrum& n,
                                                                 const radiometry::Spectrum& k);

  static RowWeights at(double cosine);
  /// Weights of all rows in the mean over a hemisphere, 2 integral of R cos d cos.
  static const std::array<double, kCount>& mean_weights();
};

/// f of the values of several spectra, at the wavelengths of any of them.
radiometry::Spectrum combined(std::span<const radiometry::Spectrum> spectra,
                              const std::function<double(std::span<const double>)>& f);

}  // namespace ifov::materials
