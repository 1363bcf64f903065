#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "math/frame.h"

namespace ifov::materials {

/// The smooth facets that a rough surface of a metal, of water or of any other body of a complex refractive index is made of; what
/// it does not reflect is absorbed. Cook and Torrance 1982 with Smith's masking and shadowing (FacetReflection), and light that
/// goes from facet to facet after Kulla and Conty 2017 (FacetAlbedo): facets that absorb nothing reflect all.
class RoughConductor final : public Bsdf {
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
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override;
  double pdf(const BsdfEvent& event) const override;
  UnitSquarePoint invert(const BsdfEvent& event) const override;
  double seam(const BsdfEvent& view) const override;
  double grey(const BsdfEvent& event) const override;
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;

 private:
  math::Frame frame_of(const BsdfEvent& event) const;
  double share_again(math::Vec3 out) const;
  double density(math::Vec3 out, math::Vec3 in) const;

  FacetDistribution facets_;
  std::shared_ptr<const FacetAlbedo> albedo_;
  double cos_direction_, sin_direction_;
  std::vector<radiometry::Spectrum>
      spectra_;  // FresnelRows, then the factor of light that is reflected again
};

}  // namespace ifov::materials
