#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "landscape/shapes/mesh_builder.h"
#include "landscape/shapes/plane.h"

namespace ifov::landscape {

/// An area of the plan, of any number of parts and holes, on a grid of 0.1 mm so that areas cut from each other
/// meet without gaps. The only user of Clipper.
class Region {
 public:
  struct Corner {
    std::int64_t x = 0, y = 0;  ///< in units of 0.1 mm
  };
  using Ring = std::vector<Corner>;

  Region() = default;
  static Region polygon(std::span<const Vec2> corners);
  static Region rectangle(const Footprint& footprint);
  static Region disc(Vec2 centre, double radius_m);
  /// What lies within half of `width_m` of a polyline, cut square at its ends.
  static Region ribbon(std::span<const Vec2> line, double width_m);

  friend Region operator+(const Region& a, const Region& b);  ///< union
  friend Region operator-(const Region& a, const Region& b);  ///< a without b
  friend Region operator&(const Region& a, const Region& b);  ///< intersection
  static Region all_of(std::span<const Region> parts);        ///< union of many

  /// Grown by a distance with rounded corners; shrunk where it is negative.
  Region grown(double by_m) const;
  double area_m2() const;
  bool empty() const { return rings_.empty(); }
  bool contains(Vec2 point) const;

  /// The area as triangles at the heights that `height_m` gives, into the builder's current slot. Large areas are
  /// cut along a lattice of `cell_m`.
  using Height = std::function<double(Vec2)>;
  void pave(MeshBuilder& mesh, const Height& height_m, double cell_m = 30.0) const;
  /// Walls along its rim from `low_m` up to `height_m`, facing outwards.
  void skirt(MeshBuilder& mesh, const Height& height_m, double low_m) const;

 private:
  void pave_cell(MeshBuilder& mesh, const Height& height_m, Corner low, Corner high, int depth) const;
  std::vector<Ring> rings_;  ///< outer ones counter-clockwise, holes clockwise
};

}  // namespace ifov::landscape
