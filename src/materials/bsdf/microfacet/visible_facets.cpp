#include "materials/bsdf/microfacet/visible_facets.h"

namespace ifov::materials {

VisibleFacets::VisibleFacets(int points_across) {
  for (int k = 0; k < points_across; ++k) {
    const double t = (k + 0.5) / points_across;
    const double both = t * (1.0 - t);
    points_.push_back({t * t * t * (10.0 - t * (15.0 - 6.0 * t)), 30.0 * both * both / points_across});
  }
}

}  // namespace ifov::materials
