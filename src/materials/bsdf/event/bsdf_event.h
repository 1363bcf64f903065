#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "math/vec3.h"

namespace ifov::materials {

enum class Side : std::uint8_t { reflected, transmitted };

/// Light that meets a surface from one direction and leaves it in another. All vectors are unit vectors; both
/// directions point away from the surface. The normal is on the side of `outgoing`; `incoming` is on the same side
/// where light is reflected, on the other where it is transmitted.
struct BsdfEvent {
  math::Vec3 outgoing;
  math::Vec3 incoming;
  math::Normal3 normal;
  math::Vec3 tangent;  ///< along the surface; zero unless the model has a direction (Bsdf::is_isotropic)
  Side side = Side::reflected;

  double outgoing_cosine() const { return math::dot(normal, outgoing); }
  /// Above 0 where `incoming` is on the event's side.
  double incoming_cosine() const {
    return (side == Side::reflected ? 1.0 : -1.0) * math::dot(normal, incoming);
  }
};

/// A Mueller matrix in several wavelengths: 16 rows of `stride` floats, column by column, so that what is made of
/// unpolarized light, the first column, is the first four.
///
/// Rows and columns are in the order I, Q, U, V, with the signs of radiometry::StokesVector. Light that arrives propagates along
/// -incoming, light that leaves along outgoing; each side is about its radiometry::surface_frame(), x in the plane
/// of its own direction and the event's normal (p) and y in the surface (s).
struct MuellerRows {
  float* values = nullptr;
  std::size_t stride = 0;
  /// False: light that arrives is unpolarized, and the first column alone is asked for.
  bool all = true;

  float* at(std::size_t row, std::size_t column) const { return values + (4 * column + row) * stride; }
  std::size_t columns() const { return all ? 4 : 1; }
};

/// Spectral parameters of a model over wavelengths or nodes.
using ParameterSpectra = std::span<const float* const>;

}  // namespace ifov::materials
