#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "materials/numbered_map.h"

namespace ifov::materials {

/// A picture on a surface: in each cell red, green and blue as bytes of sRGB (the lowest byte is red), and how opaque it is.
class ColourImage final : public NumberedMap {
 public:
  /// `cells` row by row from the upper left corner; throws InputError unless there are width x height of them.
  ColourImage(MapGrid grid, std::vector<std::uint32_t> cells);
  std::uint32_t at(const MapPosition& position) const { return cells_[grid_.cell_at(position)]; }
  /// By the luma of its code (ITU-R BT.601): about how bright it is.
  float number(std::size_t cell) const override;
  const std::vector<std::uint32_t>& cells() const { return cells_; }

 private:
  std::vector<std::uint32_t> cells_;
};

/// Colours as mixtures of a few: each lies in one of the tetrahedra into which a lattice of kLevels^3 colours cuts the cube of linear
/// sRGB, and its corners, weighed by its barycentric coordinates, have its colour: colours of reflectances side by side add up as light
/// does. Levels are evenly spaced in the coding of sRGB, about as eyes tell them apart.
class ColourLattice {
 public:
  static constexpr std::size_t kLevels = 17;
  static constexpr std::size_t kCorners = kLevels * kLevels * kLevels;

  /// Colours of a picture are multiplied by `factor` (linear, 0 to 1).
  explicit ColourLattice(const std::array<double, 3>& factor);

  struct Part {
    std::uint32_t corner = 0;
    double share = 0.0;
  };
  struct Mix {
    std::array<Part, 4> parts;
    std::size_t count = 0;
  };
  /// Shares are above 0 and sum to 1 within 1e-6; `rgba` as of ColourImage, what is opaque does not count.
  Mix mix(std::uint32_t rgba) const;

  /// Linear sRGB of a corner.
  static std::array<double, 3> colour(std::uint32_t corner);

 private:
  struct Place {
    std::uint32_t level = 0;
    double above = 0.0;  ///< share of the next level
  };
  std::array<std::array<Place, 256>, 3> places_;  ///< by colour and its code
};

}  // namespace ifov::materials
