#pragma once

#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// Light that is reflected once by facets, which reflect as mirrors do: what it is without their Fresnel reflectance. Directions as
/// FacetDistribution has them, both above the horizon.
struct FacetReflection {
  double
      bsdf;  ///< 1/sr: D G / (4 cos out cos in), Cook and Torrance 1982; G is Smith's, of heights that both directions share
             ///< (Heitz 2014, eq. 99)
  double
      density;    ///< 1/sr: with which reflection by a visible facet finds `in`; bsdf x cos in / density <= 1
  double cosine;  ///< of the angle of incidence on the facets

  /// The same number both ways, to the last bit.
  FacetReflection(const FacetDistribution& facets, math::Vec3 out, math::Vec3 in);
};

}  // namespace ifov::materials
