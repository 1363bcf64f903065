#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "math/vec3.h"

namespace ifov::materials {

/// A direction drawn for light that leaves a surface towards `outgoing`.
struct ScatterSample {
  math::Vec3 incoming;  ///< unit, from the surface towards where the light comes from
  double weight = 0.0;  ///< BRDF x cosine / pdf, without the spectral factor; 0 where nothing is scattered
  double pdf = 0.0;     ///< per steradian; 0 for a delta
  bool delta = false;   ///< the direction is the only one: evaluate() and pdf() are 0
};

/// The two numbers from which a direction was drawn.
struct UnitSquarePoint {
  double u1 = 0.0, u2 = 0.0;
};

/// How a surface spreads the light it reflects. The spectral part is a factor outside: BRDF(lambda) =
/// reflectance(lambda) x evaluate(). All directions are unit vectors that point away from the surface; the
/// normal is on the side of `outgoing`. Reciprocal, and scatters all that the factor leaves: the
/// directional-hemispherical reflectance of the shape is 1, so emissivity is 1 - reflectance (Kirchhoff).
class Scattering {
 public:
  virtual ~Scattering() = default;
  virtual bool is_delta() const = 0;
  virtual ScatterSample sample(math::Vec3 outgoing, math::Normal3 normal, double u1, double u2) const = 0;
  /// 1/sr; 0 below the surface.
  virtual double evaluate(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const = 0;
  /// Density with which sample() draws `incoming`, 1/sr.
  virtual double pdf(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const = 0;
  /// The numbers from which sample() draws `incoming`.
  virtual UnitSquarePoint invert(math::Vec3 outgoing, math::Vec3 incoming, math::Normal3 normal) const = 0;
};

enum class ScatteringKind { lambertian, mirror };

/// One row per member of the family: its name in documents and what it is.
struct ScatteringEntry {
  ScatteringKind kind;
  std::string_view name;
  std::string_view description;
};
std::span<const ScatteringEntry> scattering_entries();

/// The shared, immutable object of a kind.
const Scattering& scattering(ScatteringKind kind);

}  // namespace ifov::materials
