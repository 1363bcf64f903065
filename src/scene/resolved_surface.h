#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/vec3.h"

namespace ifov::scene {

/// One of the materials that share a surface point.
struct Constituent {
  std::uint32_t state, material;  ///< index into Scene::states; the material of that
  double weight;                  ///< share of the area, above 0
  double mapped_temperature_k;    ///< where above 0 it replaces the state's own
  double deviation_k = 0.0;       ///< standard deviation of that where it is estimated by chance
  float else_k = 0.0f, times = 1.0f, else_deviation_k = 0.0f;  ///< as of EstimatedTemperature
};

/// What a surface is at a point. Reflected, transmitted and emitted light are those of the constituents side by
/// side, weighed by area: reflectance sum(w rho), transmittance sum(w tau), emission sum(w (1 - rho - tau) B(T)).
///
/// Whoever changes it keeps: 1 <= count <= kMost; weights of the first `count` constituents above 0 and summing to 1
/// within 1e-6; `material` the one of `state`; `shading_normal` unit and on the side of the geometric normal (their
/// dot product above 0). Entries from `count` on mean nothing.
struct ResolvedSurface {
  static constexpr std::size_t kMost = 4;
  std::array<Constituent, kMost> constituents;
  std::size_t count;
  math::Normal3 shading_normal;  ///< outside of the surface, as SurfacePoint's

  const Constituent* begin() const { return constituents.data(); }
  const Constituent* end() const { return constituents.data() + count; }
};

}  // namespace ifov::scene
