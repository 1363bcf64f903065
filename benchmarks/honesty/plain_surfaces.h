#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_point.h"
#include "honesty/plain_spectra.h"
#include "honesty/random_stream.h"
#include "materials/bsdf/bsdf.h"
#include "math/ray.h"
#include "scene/scene.h"

namespace ifov::benchmarks {

/// Surfaces whose model is not separable (metals, coats, panes, water), for the plain tracers: the model's own BSDF and
/// samples, which tests hold against sources of their own, in the columns of PlainSpectra. How paths go on and how light is
/// sought is not the program's.
class PlainSurfaces {
 public:
  /// Keeps references.
  PlainSurfaces(const scene::Scene& scene, const PlainSpectra& spectra);

  bool is_plain(std::uint32_t material) const { return bsdf(material).is_separable(); }
  bool is_delta(std::uint32_t material) const { return bsdf(material).is_delta(); }
  const materials::Bsdf& bsdf(std::uint32_t material) const { return *scene_.materials[material].bsdf; }

  /// An event of a surface met from `outgoing`; `side` is its geometric normal there.
  materials::BsdfEvent view(std::uint32_t material, math::Vec3 outgoing, math::Vec3 side) const;
  /// BSDF by column, 1/sr; of a delta the share of radiance.
  std::vector<double> evaluate(std::uint32_t material, const materials::BsdfEvent& event) const;

  /// How a path goes on: false where it ends. `factors` of radiance by column, over the probability of what was chosen.
  struct Step {
    materials::BsdfEvent event;
    std::vector<double> factors;
    double pdf = 0.0;  ///< 1/sr, of the side and the direction; 0 of a delta
  };
  bool step(std::uint32_t material, materials::BsdfEvent view, RandomStream& random, Step& step) const;
  /// Density with which step() finds an event, 1/sr.
  double pdf(std::uint32_t material, const materials::BsdfEvent& event) const;

  /// What the medium is that a path is in after a step; null: none.
  const std::vector<double>* medium_after(std::uint32_t material, materials::Side side,
                                          const std::vector<double>* before) const;

  /// Share of light that comes through along a ray, by column: panes let it pass straight on, all else blocks it. False:
  /// nothing does.
  bool comes_through(math::Ray ray, std::vector<double>& share) const;

 private:
  double reflected_share(std::uint32_t material, const materials::BsdfEvent& view) const;

  const scene::Scene& scene_;
  std::size_t columns_;
  std::vector<std::vector<std::vector<float>>> values_;  // by material and spectrum
  std::vector<std::vector<const float*>> parameters_;    // by material
  std::vector<std::vector<double>> absorption_;          // 1/m, by material
  bool any_pane_ = false;
};

/// The geometric normal on the side of a ray's origin.
math::Vec3 side_of(const geometry::SurfacePoint& hit);

}  // namespace ifov::benchmarks
