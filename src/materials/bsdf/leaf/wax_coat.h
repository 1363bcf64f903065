#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "materials/bsdf/microfacet/coat_rows.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/two_lobes.h"

namespace ifov::materials {

/// The lit side of a WaxedLeaf.
class WaxCoat final : public TwoLobes {
 public:
  // Places in spectra_: FresnelRows; the factor of light that facets reflect again; CoatRows; what is under
  // the wax, over T_mean, to either side.
  static constexpr std::size_t kAgain = FresnelRows::kCount, kPassed = kAgain + 1,
                               kBack = kPassed + CoatRows::kCount, kThrough = kBack + 1;

  WaxCoat(const radiometry::Spectrum& index, double width, const radiometry::Spectrum& inner_reflectance,
          const radiometry::Spectrum& inner_transmittance);

  LobeSlopes lobe_slopes() const override { return {facets_.width_x(), facets_.width_x()}; }
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;
  /// T(cos out) T(cos in) x parameters[`place`] / pi.
  static void spread(double cosine_out, double cosine_in, ParameterSpectra parameters, std::size_t place,
                     std::size_t count, float* bsdf);
  /// The same with polarization.
  void spread_mueller(double cosine_out, double cosine_in, ParameterSpectra parameters, std::size_t place,
                      std::size_t count, const MuellerRows& rows) const;
  /// The same by the mean levels of the spectra.
  double grey_spread(double cosine_out, double cosine_in, std::size_t place) const;

 private:
  double broad_share(math::Vec3 out) const override;
  math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const override;
  double density(Lobe lobe, const Directions& event) const override;
  sampling::Point2 undraw(Lobe lobe, const Directions& event) const override;
  double grey_bsdf(const Directions& event) const override;
  double narrow_grey(const Directions& event) const override;

  FacetDistribution facets_;
  std::shared_ptr<const FacetAlbedo> albedo_;
  std::vector<radiometry::Spectrum> spectra_;
  std::vector<radiometry::Spectrum>
      polarization_;  // FresnelRows::polarization_of_index, CoatRows::polarization_of_fresnel
  std::vector<double> grey_;
};

}  // namespace ifov::materials
