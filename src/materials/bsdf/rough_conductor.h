#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/two_lobes.h"

namespace ifov::materials {

/// The smooth facets that a rough surface of a metal, of water or of any other body of a complex refractive index is made of; what
/// it does not reflect is absorbed. Cook and Torrance 1982 with Smith's masking and shadowing (FacetReflection), and light that
/// goes from facet to facet after Kulla and Conty 2017 (FacetAlbedo): facets that absorb nothing reflect all.
class RoughConductor final : public TwoLobes {
 public:
  static const BsdfModel kModel;

  struct Facets {
    FacetShape shape = FacetShape::ggx;
    double width_x, width_y;     ///< along the direction and across it, slopes; above 0
    double direction_rad = 0.0;  ///< of the first, from the tangent, counterclockwise as seen from outside
  };
  /// Refractive index n + ik, n > 0 and k >= 0 (else InputError). `factor`, 0 to 1, multiplies all that is reflected.
  RoughConductor(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                 const radiometry::Spectrum& factor, Facets facets);

  bool is_isotropic() const override { return facets_.width_x() == facets_.width_y(); }
  LobeSlopes lobe_slopes() const override;
  bool lobe_is_all() const override { return true; }
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  /// Light that facets reflect once is polarized as Fresnel has it; light that they reflect again is not.
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  double broad_share(math::Vec3 out) const override;
  math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const override;
  double density(Lobe lobe, const Directions& event) const override;
  sampling::Point2 undraw(Lobe lobe, const Directions& event) const override;
  double grey_bsdf(const Directions& event) const override;
  double narrow_grey(const Directions& event) const override;
  double widened_grey(const Directions& event, double slope) const override;

  FacetDistribution facets_;
  std::shared_ptr<const FacetAlbedo> albedo_;
  std::vector<radiometry::Spectrum>
      spectra_;  // FresnelRows, then the factor of light that is reflected again
  std::vector<radiometry::Spectrum> polarization_;  // FresnelRows::polarization_of_index
};

}  // namespace ifov::materials
