#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "materials/bsdf/microfacet/row_weights.h"
#include "radiometry/fresnel.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

/// Shares of unpolarized light that a boundary reflects and lets through.
struct BoundaryShares {
  double reflected = 0.0, transmitted = 0.0;
  explicit BoundaryShares(const radiometry::PowerShares& both)
      : reflected(0.5 * (both.reflected_p + both.reflected_s)),
        transmitted(0.5 * (both.transmitted_p + both.transmitted_s)) {}
};

/// Shares by angle as spectra, between which they are cubic: what is linear in these is exact in the mean over a channel. Angles are
/// cos = (k / (rows - 1))^3, so that they crowd where light grazes.
namespace boundary_rows {

inline constexpr std::size_t kRows = 33;

/// Of a wavelength, um, and the cosine of the angle of incidence.
using Shares = std::function<BoundaryShares(double um, double cosine)>;
/// Any numbers of the two, as many as are tabulated.
using Numbers = std::function<void(double um, double cosine, double* values)>;

/// What it depends on, and how fast it may swing.
struct Source {
  std::vector<const radiometry::Spectrum*> spectra;
  /// Optical paths that interfere or absorb, in um: 0 where nothing depends on the wavelength but by the spectra.
  double thickness_um = 0.0;
  bool interferes = false;
};

/// All reflected rows, then all transmitted ones: at the wavelengths of the spectra and as many more as are needed so that they
/// are linear between them within 2e-4. Of constants that depend on the wavelength all the same: from 0.1 to 1000 um.
std::vector<radiometry::Spectrum> tabulated(const Source& source, std::size_t rows, const Shares& shares);
/// The same of `count` (at most kMostNumbers) numbers, all rows of the first before those of the second.
inline constexpr std::size_t kMostNumbers = 8;
std::vector<radiometry::Spectrum> tabulated(const Source& source, std::size_t rows, std::size_t count,
                                            const Numbers& numbers);

inline double cosine(std::size_t row, std::size_t rows) {
  const double t = static_cast<double>(row) / static_cast<double>(rows - 1);
  return t * t * t;
}
inline RowWeights at(double cosine, std::size_t rows) {
  return cubic_weights(std::cbrt(std::clamp(cosine, 0.0, 1.0)) * static_cast<double>(rows - 1), rows);
}

}  // namespace boundary_rows

}  // namespace ifov::materials
