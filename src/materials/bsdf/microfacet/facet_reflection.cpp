#include "materials/bsdf/microfacet/facet_reflection.h"

#include <algorithm>
#include <cmath>

namespace ifov::materials {

FacetReflection::FacetReflection(const FacetDistribution& facets, math::Vec3 out, math::Vec3 in) {
  const double d = facets.density(math::normalized(out + in));
  const double area_out = facets.projected_area(out), area_in = facets.projected_area(in);
  // cos out cos in (1 + Lambda out + Lambda in), which nears 0 without a pole at the horizon.
  bsdf = 0.25 * d / (area_out * in.z + area_in * out.z - out.z * in.z);
  density = 0.25 * d / area_out;
  cosine = std::sqrt(std::clamp(0.5 + 0.5 * math::dot(out, in), 0.0, 1.0));
}

}  // namespace ifov::materials
