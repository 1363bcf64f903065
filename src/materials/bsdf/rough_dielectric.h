#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/two_lobes.h"

namespace ifov::materials {

/// Lacquer, gloss paint, varnished wood: a clear coat with a rough surface on a Lambertian base, whose reflectance is the
/// material's. The surface reflects as facets do (FacetReflection, FacetAlbedo); what it lets through, T(cos) = 1 - its own
/// directional-hemispherical reflectance, is spread by the base, and goes to and fro under the surface, which returns r = 1 -
/// T_mean / n^2 of it (radiance grows by n^2, and a clear surface passes as much one way as the other):
///   f = f_surface + T(cos out) T(cos in) / (pi T_mean) x (1 - r) base / (1 - r base).
/// Reciprocal, and a white base sends back all that arrives. Of a smooth surface it is Wolff 1994 (Diffuse-reflectance model for
/// smooth dielectric surfaces, J. Opt. Soc. Am. A 11) with all reflections; the split by T is Kelemen and Szirmay-Kalos 2001.
class RoughDielectric final : public TwoLobes {
 public:
  static const BsdfModel kModel;
  /// n, 1 or more, of the coat, which absorbs nothing; InputError else.
  RoughDielectric(const radiometry::Spectrum& n, const radiometry::Spectrum& base, FacetShape shape,
                  double width);

  LobeSlopes lobe_slopes() const override;
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  /// The surface polarizes what it reflects once, and what it lets through: light of the base, unpolarized and alike from all
  /// sides below the surface, leaves as (T, T_Q, 0, 0) in the plane of its direction and the normal, T_Q = - its own
  /// DHR_10 (as Kirchhoff has it for emission), and light that enters counts as it does by reciprocity.
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  static constexpr std::size_t kAngles = 33;  // of T
  // Places in spectra_: FresnelRows; the factor of light that facets reflect again; T by angle; its mean; what the base returns.
  static constexpr std::size_t kPassedQ = 3 * FresnelRows::kCount;  // in polarization_
  static constexpr std::size_t kAgain = FresnelRows::kCount, kPassed = kAgain + 1, kMean = kPassed + kAngles,
                               kBase = kMean + 1;
  double broad_share(math::Vec3 out) const override;
  math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const override;
  double density(Lobe lobe, const Directions& event) const override;
  sampling::Point2 undraw(Lobe lobe, const Directions& event) const override;
  double grey_bsdf(const Directions& event) const override;
  double narrow_grey(const Directions& event) const override;
  double widened_grey(const Directions& event, double slope) const override;
  /// What facets reflect once, grey, 1/sr.
  double reflected(const FacetDistribution& facets, const Directions& event) const;
  static RowWeights passed_at(double cosine);
  void add_spectra(const radiometry::Spectrum& n, const radiometry::Spectrum& base);
  double grey_passed(double cosine) const;

  FacetDistribution facets_;
  std::shared_ptr<const FacetAlbedo> albedo_;
  std::vector<radiometry::Spectrum> spectra_;
  std::vector<radiometry::Spectrum> polarization_;  // FresnelRows::polarization_of_index; T_Q by angle
  std::vector<double> grey_;                        // means of the spectra over their wavelengths
};

}  // namespace ifov::materials
