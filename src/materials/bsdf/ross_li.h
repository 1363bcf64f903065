#pragma once

#include <array>

#include "materials/bsdf/bsdf_model.h"

namespace ifov::materials {

/// The kernels of the BRDF products of MODIS (AMBRALS; Wanner, Li and Strahler 1995, J. Geophys. Res. 100, D10; Lucht, Schaaf
/// and Strahler 2000, IEEE TGRS 38): isotropic, RossThick (volume of leaves) and LiSparse-reciprocal (crowns and their
/// shadows, h/b = 2, b/r = 1). BRDF = (f_iso + f_vol K_vol + f_geo K_geo) / pi, 0 where that is negative. The material's
/// reflectance is f_iso. Directions as ReflectionAngles has them.
class RossLi final : public Bsdf {
 public:
  static const BsdfModel kModel;
  /// `hot_spot_rad`: half width of the volume's hot spot, to which Maignan, Breon and Lacaze 2004 (Remote Sens. Environ. 90)
  /// give 1.5 deg; 0: none, the kernel of MODIS.
  RossLi(radiometry::Spectrum isotropic, radiometry::Spectrum volumetric, radiometry::Spectrum geometric,
         double hot_spot_rad = 0.0);

  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

  /// K_vol and K_geo.
  std::array<double, 2> kernels(const BsdfEvent& event) const;

 private:
  std::array<radiometry::Spectrum, 3> spectra_;
  double hot_spot_rad_;
};

}  // namespace ifov::materials
