#include "sampling/accuracy/weights/cell_weights.h"

#include "sampling/footprint_groups.h"

namespace ifov::sampling {

CellWeights::CellWeights(const ColumnFootprints& footprints, int cells_per_pixel)
    : reach_(footprints.reach()), cells_per_pixel_(cells_per_pixel) {
  const auto fill = [&](std::vector<double>& to, int parts) {
    const int n = (2 * reach_ + 1) * parts;
    const double side = 1.0 / parts, first = -reach_ - 0.5;
    for (std::size_t group = 0; group < footprints.groups(); ++group)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double x = first + i * side, y = first + j * side;
          to.push_back(footprints.integral(group, 0, x, y, x + side, y + side));
        }
  };
  fill(pixels_, 1);
  fill(cells_, cells_per_pixel_);
}

}  // namespace ifov::sampling
