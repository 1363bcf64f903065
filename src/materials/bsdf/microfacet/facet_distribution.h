#pragma once

#include <algorithm>
#include <cstdint>

#include "math/vec3.h"
#include "sampling/random.h"

namespace ifov::materials {

enum class FacetShape : std::uint8_t { ggx, beckmann };

/// Normals of the facets of a rough surface and what of them is seen: GGX (Trowbridge and Reitz 1975; Walter et al. 2007) or
/// Beckmann (slopes Gaussian, of standard deviation width / sqrt 2), with the masking of Smith (1967) for facets whose heights
/// and slopes do not depend on those beside them, as Heitz 2014 (Understanding the masking-shadowing function, JCGT 3(2)).
/// Unit vectors, z along the mean normal, x along the first width; directions point away from the surface, z >= 0.
class FacetDistribution {
 public:
  /// Both widths above 0: alpha of Walter et al., in slope.
  FacetDistribution(FacetShape shape, double width_x, double width_y)
      : shape_(shape), width_x_(width_x), width_y_(width_y) {}

  double width_x() const { return width_x_; }
  double width_y() const { return width_y_; }

  /// Of the same shape, no narrower than `least`.
  FacetDistribution widened(double least) const {
    return {shape_, std::max(width_x_, least), std::max(width_y_, least)};
  }

  /// D: area of facets by solid angle of their normals, over the mean surface's area, 1/sr.
  double density(math::Vec3 facet) const;
  /// Area of the facets that are seen from a direction, as projected towards it, over the mean surface's area: cosine x (1 + Lambda).
  double projected_area(math::Vec3 direction) const;

  /// Draws the normal of a facet that is seen from `view`, in proportion to the area of it that is seen: density
  /// D max(0, view.facet) / projected_area(view) (GGX: Heitz 2018, JCGT 7(4), by the spherical caps of Dupuy and Benyoub 2023;
  /// Beckmann: Heitz and d'Eon 2014, by inversion of its closed distribution functions).
  math::Vec3 sample_visible(math::Vec3 view, sampling::Point2 u) const {
    return VisibleRow(*this, view, u.x).facet(u.y);
  }
  /// The numbers from which sample_visible() draws `facet`.
  sampling::Point2 invert_visible(math::Vec3 view, math::Vec3 facet) const;

  /// All that sample_visible() draws with one u.x.
  class VisibleRow {
   public:
    VisibleRow(const FacetDistribution& facets, math::Vec3 view, double u1);
    math::Vec3 facet(double u2) const;

   private:
    const FacetDistribution& facets_;
    math::Vec3 view_;       // where widths are stretched to 1
    double x_, y_, slope_;  // GGX: azimuth on the cap; Beckmann: of the view, and the slope along it
  };

 private:
  math::Vec3 stretched(math::Vec3 direction) const;

  FacetShape shape_;
  double width_x_, width_y_;
};

}  // namespace ifov::materials
