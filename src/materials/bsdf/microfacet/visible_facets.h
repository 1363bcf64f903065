#pragma once

#include <vector>

#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// A quadrature over the light that facets reflect once: facets drawn by their visible area on a grid of the unit square, whose
/// points crowd at its edges (the polynomial transformation of Korobov 1963, of fifth degree), where directions graze.
class VisibleFacets {
 public:
  explicit VisibleFacets(int points_across = 48);

  /// use(weight, cosine of incidence on the facet): the sum of weight x R(cosine) is the directional-hemispherical
  /// reflectance towards `out` of facets whose Fresnel reflectance is R.
  template <class Use>
  void for_each_reflection(const FacetDistribution& facets, math::Vec3 out, const Use& use) const {
    const double area_out = facets.projected_area(out);
    for (const Point& x : points_)
      for (const Point& y : points_) {
        const math::Vec3 facet = facets.sample_visible(out, {x.u, y.u});
        const double cosine = math::dot(out, facet);
        const math::Vec3 in = 2.0 * cosine * facet - out;
        if (!(in.z > 0.0)) continue;
        const double lit = area_out * in.z;
        use(x.weight * y.weight * lit / (lit + facets.projected_area(in) * out.z - out.z * in.z), cosine);
      }
  }

 private:
  struct Point {
    double u, weight;
  };
  std::vector<Point> points_;
};

}  // namespace ifov::materials
