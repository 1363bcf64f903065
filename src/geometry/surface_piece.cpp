#include "geometry/surface_piece.h"

#include <cmath>
#include <numbers>

namespace ifov::geometry {

double area_m2(const SurfacePiece& piece) {
  const math::Transform& map = piece.scene_from_unit;
  const double stretch = std::cbrt(std::abs(map.determinant()));
  const double parallelogram = math::length(math::cross(map.column_x(), map.column_y()));
  switch (piece.kind) {
    case PieceKind::triangle: return 0.5 * parallelogram;
    case PieceKind::parallelogram: return parallelogram;
    case PieceKind::disk: return std::numbers::pi * parallelogram;
    case PieceKind::open_cylinder:
      return std::numbers::pi * (math::length(map.column_x()) + math::length(map.column_y())) *
             math::length(map.column_z());
    case PieceKind::ball: return 4.0 * std::numbers::pi * stretch * stretch;
    case PieceKind::hemisphere: return 2.0 * std::numbers::pi * stretch * stretch;
  }
  return 0.0;
}

}  // namespace ifov::geometry
