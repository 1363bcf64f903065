#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_reflection.h"
#include "materials/bsdf/two_lobes.h"

namespace ifov::materials {

/// BRDFs of targets as they are fitted to measurements: facets that reflect once, and unpolarized light from
/// below them,
///   f = F(c) D(h) M / (4 cos out cos in) + diffuse / pi + 2 volume / (pi (cos out + cos in)),
/// with F the Fresnel reflectance at the angle of incidence c on the facets and h their normal
/// (FacetReflection). The models of this kind differ in D and in M, the share that is neither masked nor
/// shadowed.
class FacetBrdf final : public TwoLobes {
 public:
  /// Priest and Germer 2000 (Proc. SPIE 4133), Priest and Meier 2002 (Opt. Eng. 41, 988): Gaussian slopes; M
  /// is that of Torrance and Sparrow 1967, as Hyde, Schmidt and Havrilla 2009 (Opt. Express 17, 22138) have
  /// it, or Smith's.
  static const BsdfModel kPriestGermer;
  /// Maxwell, Beard et al. 1973, as the NEF database has it (Westlund and Meyer 2002): D = B / (cos^3
  /// (slope^2 + tan^2)).
  static const BsdfModel kMaxwellBeard;
  /// Shell 2005 (thesis, RIT): facets of Priest and Germer with the obscuration of Maxwell and Beard.
  static const BsdfModel kShellTarget;

  enum class Slopes : std::uint8_t {
    gaussian,      ///< of standard deviation `slope` along any direction
    maxwell_beard  ///< D as above
  };
  enum class Masking : std::uint8_t { smith, torrance_sparrow };
  /// Maxwell and Beard's share of what is neither masked nor shadowed, (1 + (t / omega) exp(-2 b / tau)) / (1
  /// + t / omega), t the angle of the facet's normal from the surface's and b that of incidence on it.
  struct Obscuration {
    double tau_rad, omega_rad;
    double share(double tilt_rad, double incidence_rad) const;
  };
  struct Surface {
    Slopes slopes = Slopes::gaussian;
    double slope;  ///< above 0
    Masking masking = Masking::smith;
    std::optional<Obscuration> obscuration = std::nullopt;  ///< of gaussian slopes times Smith's masking
    double scale = 1.0;                                     ///< of D
  };
  /// `n` + ik: the facets' refractive index. `diffuse` and `volume`, 0 to 1.
  FacetBrdf(const Surface& surface, const radiometry::Spectrum& n, const radiometry::Spectrum& k,
            const radiometry::Spectrum& diffuse, const radiometry::Spectrum& volume);

  LobeSlopes lobe_slopes() const override;
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

  /// Of maxwell_beard the model as published grows without bound towards the horizon: either direction beyond
  /// the angle of this cosine counts as if it were there, so that no more comes back than arrives.
  double least_cosine() const { return least_cosine_; }
  /// B of maxwell_beard for which the facets together cover the surface: 2 pi B times the integral of tan /
  /// ((slope^2 + tan^2) sqrt(1 + tan^2)) d tan is 1.
  static double covering_bias(double slope);

 private:
  double broad_share(math::Vec3 out) const override;
  math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const override;
  double density(Lobe lobe, const Directions& event) const override;
  sampling::Point2 undraw(Lobe lobe, const Directions& event) const override;
  double grey_bsdf(const Directions& event) const override;
  double narrow_grey(const Directions& event) const override;
  FacetReflection reflection(const Directions& event) const;
  /// Over a few angles of light, with the largest Fresnel reflectance of any wavelength.
  double highest_reflectance() const;

  Surface surface_;
  FacetDistribution drawn_;                    // by which directions are drawn
  std::vector<radiometry::Spectrum> spectra_;  // FresnelRows, diffuse, volume
  std::vector<radiometry::Spectrum> polarization_;
  std::vector<double> grey_;
  double least_cosine_ = 0.02;
};

}  // namespace ifov::materials
