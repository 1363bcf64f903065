#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/coat_rows.h"
#include "materials/bsdf/microfacet/facet_albedo.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"
#include "materials/bsdf/sea/sea_slopes.h"
#include "materials/bsdf/two_lobes.h"

namespace ifov::materials {

/// The sea under a wind:
///   f = W foam / pi + (1 - W) [facets + T(cos out) T(cos in) / T(1)^2 x below / pi]
/// Facets of sea water with slopes of Cox and Munk (SeaSlopes), masked and shadowed after Smith 1967, as in
/// FacetReflection, and light that goes from one to another (FacetAlbedo). W is the share of whitecaps
/// (whitecap_share). `below` is the water-leaving reflectance, pi x radiance / irradiance just above the
/// surface, seen and lit from straight above; it passes the surface twice, and slanting light is let through
/// less, T(cos) = 1 - the surface's own reflectance.
class Sea final : public TwoLobes {
 public:
  static const BsdfModel kModel;

  struct Surface {
    double wind_m_s;
    SlopeStatistics slopes = SlopeStatistics::anisotropic;
    double wind_from_rad = 0.0;                      ///< azimuth where it comes from, clockwise from north
    double salinity = 35.0;                          ///< g/kg
    std::optional<double> whitecaps = std::nullopt;  ///< their share, 0 to 1, in place of that of the wind
  };
  Sea(const Surface& surface, const radiometry::Spectrum& below, const radiometry::Spectrum& foam);

  bool is_isotropic() const override {
    return slopes_.variance_along() == slopes_.variance_across() && !slopes_.is_skewed();
  }
  LobeSlopes lobe_slopes() const override;
  std::span<const radiometry::Spectrum> spectra() const override { return spectra_; }
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override { return polarization_; }
  /// What facets reflect once, and what leaves through the surface; light of whitecaps is unpolarized.
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

  const SeaSlopes& slopes() const { return slopes_; }

 private:
  // Places in spectra_: FresnelRows; the factor of light that facets reflect again; CoatRows; what comes from
  // below; foam.
  static constexpr std::size_t kAgain = FresnelRows::kCount, kPassed = kAgain + 1,
                               kBelow = kPassed + CoatRows::kCount, kFoam = kBelow + 1;
  double broad_share(math::Vec3 out) const override;
  math::Vec3 draw(Lobe lobe, math::Vec3 out, sampling::Point2 u) const override;
  double density(Lobe lobe, const Directions& event) const override;
  sampling::Point2 undraw(Lobe lobe, const Directions& event) const override;
  double grey_bsdf(const Directions& event) const override;
  double narrow_grey(const Directions& event) const override;

  SeaSlopes slopes_;
  double
      even_width_;  // of facets as steep to all sides, for light reflected twice and T, in which the direction is lost
  std::shared_ptr<const FacetAlbedo> albedo_;
  std::vector<radiometry::Spectrum> spectra_;
  std::vector<radiometry::Spectrum>
      polarization_;          // FresnelRows::polarization_of_index, CoatRows::polarization_of_fresnel
  std::vector<double> grey_;  // means of the spectra over their wavelengths
};

/// Share of the sea that whitecaps cover, 2.95e-6 U^3.52 (Monahan and O'Muircheartaigh 1980, J. Phys.
/// Oceanogr. 10), at most 1.
double whitecap_share(double wind_m_s);
/// Effective reflectance of whitecaps through their lives: 0.22 in visible light (Koepke 1984, Appl. Opt. 23,
/// 1816), beyond 0.7 um less, as the code 6S tabulates it to 2.5 um; 0 beyond.
const radiometry::Spectrum& whitecap_reflectance();
/// Real part of the index of sea water: that of pure water and 0.006 at a salinity of 34.3 g/kg, in
/// proportion to it (McLellan 1965 and Friedman 1969, as 6S has it for 0.25 to 4 um).
radiometry::Spectrum sea_water_index(double salinity);

}  // namespace ifov::materials
