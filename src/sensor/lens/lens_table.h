#pragma once

#include <vector>

#include "sensor/lens/lens.h"

namespace ifov::sensor {

/// Distortion along the radius by a table: a direction r beside the axis appears r' beside it, both in focal lengths. Between rows a monotone
/// cubic (Fritsch and Carlson 1980), from (0, 0) on; beyond the last it goes on straight.
class LensTable final : public Lens {
 public:
  struct Row {
    double radius = 0.0, displaced = 0.0;
  };
  /// One row at least, both columns above 0 and increasing.
  explicit LensTable(const std::vector<Row>& rows);

  Place image_of(Place direction) const override;
  Place direction_of(Place image) const override;
  double scale(Place direction) const override;

 private:
  struct Along {
    double displaced, slope;
  };
  Along along(double radius) const;

  std::vector<double> radii_, displaced_, slopes_;
};

}  // namespace ifov::sensor
