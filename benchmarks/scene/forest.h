#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ifov::benchmarks {

/// The forest of the speed benchmarks: 1 km x 1 km of fractal terrain (999,698 triangles on 1.41 m posts,
/// about 100 m of relief) under 10,000 placings of one tree of 5,000 triangles (100 of trunk, 4,900 of leaf
/// cards; crown radius 3.5 m, leaf area index about 5.6): 51 million triangles as seen by a ray.
struct ForestMesh {
  std::vector<double> vertices_m;      ///< x, y, z
  std::vector<std::uint32_t> corners;  ///< three per triangle
  std::vector<std::uint32_t> slots;    ///< material per triangle
};

struct TreePosition {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0, yaw_deg = 0.0, scale = 1.0;
};

inline constexpr double kForestSide_m = 1000.0;
inline constexpr int kForestGroundMaterials = 32;

double forest_terrain_height_m(double x_m, double y_m);
ForestMesh forest_terrain();
ForestMesh forest_tree();  ///< slot 0: leaves, 1: bark
std::vector<TreePosition> tree_positions();

/// Reflectance of material m (0 to 31 ground, 32 leaves, 33 bark) in band b: uniform random in [0.05, 0.55].
double forest_reflectance(int material, int band);

/// A document over the files of write_forest: `bands` monochromatic channels (or Gaussian ones of 10 nm) from
/// 0.4 um on, a point Sun of 1000 W m-2 um-1 35 degrees from the zenith and a nadir camera over the forest's
/// middle. `sky_w_m2_sr_um` is the radiance of the sky; `sampling` the document's sampling, as JSON.
struct ForestView {
  int bands = 210;
  bool gaussian = false;
  int pixels = 1024;  ///< along each side
  double side_m = 980.0;
  double sky_w_m2_sr_um = 0.0;
  std::string sampling;
};
inline constexpr double kForestSun_w_m2_um = 1000.0;
std::string forest_document(const ForestView& view);

/// Writes terrain.obj, tree.obj and trees.csv; the same bytes each time. Throws std::runtime_error where it
/// cannot.
void write_forest(const std::filesystem::path& folder);

}  // namespace ifov::benchmarks
