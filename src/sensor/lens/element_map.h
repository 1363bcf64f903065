#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sensor/lens/lens.h"

namespace ifov::sensor {

/// Where elements of a frame or a line look, by a table: directions at places of a grid on the focal plane, which they pass through exactly.
/// Between them cubics along both axes whose slopes are those of parabolas through three neighbours, so that neighbouring elements join
/// smoothly; beyond the outermost it goes on straight.
class ElementMap final : public Lens {
 public:
  /// Places rise along either axis, two at least along x; a single y: a line of elements, about which directions go on as through a
  /// pinhole. `directions`: row by row.
  ElementMap(std::vector<double> x, std::vector<double> y, const std::vector<Place>& directions);

  Place image_of(Place direction) const override;
  Place direction_of(Place image) const override;
  double scale(Place direction) const override;

  /// Area of directions over that of the image near a place; 0 or less: neighbours change sides.
  double area(Place image) const;
  /// The same along x of a line.
  double stretch(Place image) const;
  /// The first node, row by row, beside which neighbours change sides.
  std::optional<std::size_t> first_fold() const;

 private:
  struct Mapped {
    Place direction, by_x, by_y;
  };
  Mapped mapped(Place image) const;

  std::vector<double> x_, y_;
  std::vector<Place> at_, by_x_, by_y_, by_both_;  // of the nodes
  Mapped middle_;
};

}  // namespace ifov::sensor
