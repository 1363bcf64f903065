#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "materials/bsdf/bsdf_model.h"
#include "materials/bsdf/microfacet/facet_distribution.h"
#include "materials/bsdf/microfacet/row_weights.h"
#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::materials {

/// What the two sides of a rough boundary share: spectra, and what of light each sends where.
struct RoughBoundaryTables;
class CosineLobe;

/// A rough boundary of a medium, which reflects and refracts: ground glass with an inside, rough water. Facets that reflect
/// (FacetReflection) and refract (FacetRefraction) once, by Fresnel's equations; what they send to other facets, E being what leaves of light
/// at once and L(cos) = 1 - E of either side, leaves diffusely on either side, as Kulla and Conty 2017 have it of metals:
///   f_again = x L(out) L(in) / (pi L_mean),   L_mean = 2 integral of L cos d cos of the side of `in`,
/// x by which of it goes to which side: t from outside through the boundary, 1 - the mean of Fresnel's reflectance, and from within
/// t L_mean(outside) / (n^2 L_mean(within)), as reciprocity asks for. What absorbs nothing sends on all that arrives. Directions are bent by
/// one index, that of the medium where it absorbs least. Facets polarize by Fresnel's matrices of what they reflect and refract, about the
/// plane of both directions, in which their normals lie; what leaves after several of them is unpolarized.
class RoughBoundary final : public Bsdf {
 public:
  static const BsdfModel kModel;

  struct Surface {
    FacetShape shape = FacetShape::ggx;
    double width;  ///< alpha, above 0
  };
  /// As seen from outside; behind() is from within. n + ik of the medium, `factor` of what is reflected. InputError where n is below 1.01 where
  /// it absorbs least: nothing is bent.
  static std::shared_ptr<const Bsdf> make(const radiometry::Spectrum& n, const radiometry::Spectrum& k,
                                          const radiometry::Spectrum& factor, const Surface& surface);

  RoughBoundary(std::shared_ptr<const RoughBoundaryTables> tables, bool from_within,
                std::shared_ptr<const Bsdf> behind);

  bool may_transmit() const override { return true; }
  Passage passage() const override { return from_within_ ? Passage::out_of : Passage::into; }
  std::shared_ptr<const Bsdf> behind() const override { return behind_; }
  double bending_index() const override;
  const radiometry::Spectrum* absorption() const override;
  BsdfSample sample(const BsdfEvent& view, double u1, double u2) const override;
  double pdf(const BsdfEvent& event) const override;
  UnitSquarePoint invert(const BsdfEvent& event) const override;
  double seam(const BsdfEvent& view) const override;
  double grey(const BsdfEvent& event) const override;
  LobeSlopes lobe_slopes() const override;
  double lobe_share(const BsdfEvent& event) const override;
  double widened_lobe(const BsdfEvent& event, double slope) const override;
  /// Facets that lean by an angle turn what comes through by n - 1 times that, about.
  double passed_spread() const override;
  /// As much of it as comes through, at this angle.
  double through_share(const BsdfEvent& view) const override;
  std::span<const radiometry::Spectrum> spectra() const override;
  void evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                float* bsdf) const override;
  bool polarizes() const override { return true; }
  std::span<const radiometry::Spectrum> polarization_spectra() const override;
  void evaluate_mueller(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                        const MuellerRows& rows) const override;

 private:
  struct Local {
    math::Vec3 out, in;
    bool through;
    bool is_possible() const { return out.z > 0.0 && (through ? in.z < 0.0 : in.z > 0.0); }
  };
  static Local local(const BsdfEvent& event);
  double ratio() const;
  /// Single scattering without Fresnel, 1/sr, its density, and the cosine outside by which Fresnel's rows go.
  struct Once {
    double bsdf = 0.0, density = 0.0, outside = 0.0;
  };
  Once once(const FacetDistribution& facets, const Local& event) const;
  /// Of basic radiance that comes through, from within over from outside.
  double from_there() const;
  const CosineLobe& diffuse(bool through) const;
  double broad_share(bool through, double cosine) const;
  double density(const Local& event, double broad) const;
  /// What facets send to others and those on, which is unpolarized.
  void add_again(const Local& event, ParameterSpectra parameters, std::size_t count, float* bsdf) const;
  double grey_once(const FacetDistribution& facets, const Local& event) const;

  std::shared_ptr<const RoughBoundaryTables> tables_;
  bool from_within_;
  std::shared_ptr<const Bsdf> behind_;
};

}  // namespace ifov::materials
