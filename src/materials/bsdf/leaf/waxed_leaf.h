#pragma once

#include <memory>
#include <vector>

#include "materials/bsdf/bsdf.h"
#include "radiometry/spectrum.h"

namespace ifov::materials {

class WaxCoat;

/// A leaf with a clear rough layer of wax on both sides: facets of the wax (FacetReflection, FacetAlbedo) in
/// place of the surface that PROSPECT has, which it takes as even in all directions, and below it what the
/// rest of the leaf reflects and transmits:
///   f = f_wax + T(cos out) T(cos in) / (pi T_mean) x (R - s) / (1 - s), on the other side tau / (1 - s),
/// with s the reflectance of PROSPECT's surface. A leaf that absorbs nothing sends on all that arrives.
class WaxedLeaf final : public Bsdf {
 public:
  /// `inner_reflectance`, `inner_transmittance`: (R - s) / (1 - s) and tau / (1 - s).
  WaxedLeaf(const radiometry::Spectrum& index, double width, const radiometry::Spectrum& inner_reflectance,
            const radiometry::Spectrum& inner_transmittance);
  ~WaxedLeaf() override;

  bool may_transmit() const override { return true; }
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override;
  double pdf(const BsdfEvent& event) const override;
  UnitSquarePoint invert(const BsdfEvent& event) const override;
  double seam(const BsdfEvent& view) const override;
  double grey(const BsdfEvent& event) const override;
  LobeSlopes lobe_slopes() const override;
  double lobe_share(const BsdfEvent& event) const override;
  std::span<const radiometry::Spectrum> spectra() const override;
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override;
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  std::unique_ptr<const WaxCoat> coat_;  // what it does on the side of the light
};

}  // namespace ifov::materials
