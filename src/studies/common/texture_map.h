#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ifov::studies {

/// Temperature differences of a mottled surface: twelve plane waves of 5 cm to 1 m with random directions and
/// phases, 2 K rms, on a square raster of 1 cm cells, bilinear between their centres.
class TextureMap {
 public:
  TextureMap(std::uint64_t seed, double side_m);

  double side_m() const { return side_; }
  /// K, at metres east and north of the raster's lower left corner.
  double at(double x_m, double y_m) const;

  /// Writes `mean_k` + texture as an ENVI raster, `<name>.img` with its header, into the folder.
  void write(const std::filesystem::path& folder, const std::string& name, double mean_k) const;

 private:
  double side_;
  int cells_;
  std::vector<float> difference_k_;  // rows from the north
};

}  // namespace ifov::studies
