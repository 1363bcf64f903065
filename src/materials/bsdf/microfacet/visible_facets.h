#pragma once

#include <cstddef>
#include <vector>

#include "materials/bsdf/microfacet/crowded_square.h"
#include "materials/bsdf/microfacet/facet_distribution.h"

namespace ifov::materials {

/// A quadrature over the light that facets reflect once: facets drawn by their visible area, at points of the unit square that
/// crowd at its edges, where directions graze.
class VisibleFacets {
 public:
  explicit VisibleFacets(int across = 80) : points_(crowded_square(across)) {
    for (std::size_t k = 0; k < points_.size(); k += static_cast<std::size_t>(across))
      rows_.push_back(points_[k].u1);
  }

  /// use(weight, cosine of incidence on the facet, where the light comes from): the sum of weight x R(cosine) is the directional-hemispherical
  /// reflectance towards `out` of facets whose Fresnel reflectance is R.
  template <class Use>
  void for_each_reflection(const FacetDistribution& facets, math::Vec3 out, const Use& use) const {
    const double area_out = facets.projected_area(out);
    const std::size_t across = rows_.size();
    for (std::size_t i = 0; i < across; ++i) {
      const FacetDistribution::VisibleRow row(facets, out, rows_[i]);
      for (std::size_t j = i * across; j < (i + 1) * across; ++j) {
        const math::Vec3 facet = row.facet(points_[j].u2);
        const double cosine = math::dot(out, facet);
        const math::Vec3 in = 2.0 * cosine * facet - out;
        if (!(in.z > 0.0)) continue;
        const double lit = area_out * in.z;
        use(points_[j].weight * lit / (lit + facets.projected_area(in) * out.z - out.z * in.z), cosine, in);
      }
    }
  }

 private:
  std::vector<SquarePoint> points_;  // by rows of one u1
  std::vector<double> rows_;
};

}  // namespace ifov::materials
