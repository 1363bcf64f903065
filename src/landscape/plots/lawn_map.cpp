#include "landscape/plots/lawn_map.h"

#include <algorithm>
#include <cmath>

#include "core/format.h"

namespace ifov::landscape {
namespace {

enum Cover { kLush = 1, kSparse, kDry, kClover, kBare };

/// How well each garden is kept, -1 to 1; 0 between gardens.
std::vector<float> care_of_gardens(const PlotPlan& plots, const RandomStream& random, double half_m,
                                   int cells) {
  std::vector<float> care(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0f);
  const double cell = 2.0 * half_m / cells;
  for (const Plot& plot : plots.plots) {
    const auto value = static_cast<float>(random.of(plot.number).between(-1.0, 1.0, 0));
    const Footprint area = plot.area();
    const double reach = std::hypot(plot.width, plot.depth);
    const auto index = [&](double at) { return std::clamp(static_cast<int>(at / cell), 0, cells - 1); };
    for (int row = index(half_m - plot.stand.origin.y - reach);
         row <= index(half_m - plot.stand.origin.y + reach); ++row)
      for (int column = index(plot.stand.origin.x - reach + half_m);
           column <= index(plot.stand.origin.x + reach + half_m); ++column) {
        const Vec2 at{-half_m + (column + 0.5) * cell, half_m - (row + 0.5) * cell};
        if (distance(area, at) <= 0.0)
          care[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells) +
               static_cast<std::size_t>(column)] = value;
      }
  }
  return care;
}

Cover cover_at(const RandomStream& random, double x, double y, double care) {
  const double drought = fractal_noise(random.of(1), x, y, 28.0, 2);
  const double patch = fractal_noise(random.of(2), x, y, 3.5, 3);
  const double tuft = fractal_noise(random.of(3), x, y, 0.45, 2);
  const double vigour = 0.32 * (1.0 - drought) + 0.36 * patch + 0.32 * tuft + 0.09 * care;
  if (vigour < 0.27) return kBare;
  if (vigour < 0.34) return kDry;
  if (vigour < 0.41) return kSparse;
  const double clover = fractal_noise(random.of(4), x, y, 2.2, 3);
  return clover > 0.68 ? kClover : kLush;
}

}  // namespace

io::MaterialBinding lawn_material(const StreetPlan& streets, const PlotPlan& plots,
                                  const RandomStream& random, SceneFolder& folder, SceneMaker& scene) {
  constexpr int kMost_cells = 4400;
  const double size = 2.0 * streets.half_m;
  io::Raster raster;
  raster.width = raster.height = std::min(kMost_cells, static_cast<int>(std::ceil(size / 0.1)));
  raster.bands = 1;
  const double cell = size / raster.width;
  raster.geotransform = {-streets.half_m, cell, 0.0, streets.half_m, 0.0, -cell};
  constexpr int kGardenCells_per_m = 2;
  const int garden_cells = static_cast<int>(size) * kGardenCells_per_m;
  const std::vector<float> care = care_of_gardens(plots, random.of(9), streets.half_m, garden_cells);
  raster.values.reserve(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height));
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column) {
      const auto r = static_cast<std::size_t>(row * garden_cells / raster.height);
      const auto c = static_cast<std::size_t>(column * garden_cells / raster.width);
      const double own = static_cast<double>(care[r * static_cast<std::size_t>(garden_cells) + c]);
      raster.values.push_back(static_cast<float>(cover_at(random, -streets.half_m + (column + 0.5) * cell,
                                                          streets.half_m - (row + 0.5) * cell, own)));
    }
  const std::string file = folder.add_map("lawn_cover", raster);
  return scene.classes(file, streets.half_m, {"lawn", "lawn, sparse", "lawn, dry", "clover", "soil"});
}

}  // namespace ifov::landscape
