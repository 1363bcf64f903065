#pragma once

#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// Light that is refracted once by facets: what it is without 1 - their Fresnel reflectance. Directions as FacetDistribution has them,
/// `out` above the horizon and `in`, where the light comes from, below it. In a medium radiance stands for basic radiance, L / n^2.
struct FacetRefraction {
  double bsdf = 0.0;  ///< 1/sr; 0 where no facet refracts one into the other
  double density =
      0.0;  ///< 1/sr: with which refraction by a visible facet finds `in`; bsdf x cos in / density <= 1
  double cosine_out = 0.0, cosine_in = 0.0;  ///< of the angles to the facet's normal, on either side

  /// `ratio`: the index on the side of `in` over that on the side of `out`.
  ///   bsdf = |in.m| (out.m) ratio^2 D G / (|cos in| cos out (out.m + ratio in.m)^2)
  /// with m = -+ (out + ratio in) / |...| above the horizon (Walter et al. 2007, equations 16, 17 and 21, the last over n^2 of both sides). G
  /// is Smith's of heights that both directions share: of facets at the height below which a share u of all lies, u^Lambda(out) are
  /// seen from above and (1 - u)^Lambda(in) from below, in the mean B(1 + Lambda(out), 1 + Lambda(in)) (the beta function).
  FacetRefraction(const FacetDistribution& facets, math::Vec3 out, math::Vec3 in, double ratio);
};

/// B(1 + Lambda(out), 1 + Lambda(in)) of two directions on either side.
double seen_from_both_sides(const FacetDistribution& facets, math::Vec3 out, math::Vec3 in);

/// Normal of the facet that refracts from `in` into `out`; zero where there is none.
math::Vec3 refracting_facet(math::Vec3 out, math::Vec3 in, double ratio);

/// The direction that a facet refracts into `out`; zero where that is reflected totally.
math::Vec3 refracted_by(math::Vec3 facet, math::Vec3 out, double ratio);

}  // namespace ifov::materials
