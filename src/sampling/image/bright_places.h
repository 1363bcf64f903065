#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "sampling/field.h"

namespace ifov::sampling {

class ColumnFootprints;
class FootprintGroups;
class PixelFootprint;
struct Point2;
struct TileProblem;

/// Where in the image something lies that outshines the scene and that a pixel's points may all miss, as rectangles that do not overlap.
/// Never changed.
class BrightPlaces {
 public:
  struct Box {
    FocalPoint centre;
    double half_width_px = 0.0, half_height_px = 0.0;
    /// Where something is known to shine in it, however small.
    std::optional<FocalPoint> brightest = {};
  };
  struct Rectangle {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
    bool holds(FocalPoint p) const { return p.x_px >= x0 && p.x_px < x1 && p.y_px >= y0 && p.y_px < y1; }
  };
  /// No rectangle is wider.
  static constexpr double kWidest_px = 0.25;

  BrightPlaces() = default;
  /// Boxes may overlap: of each square of kWidest_px what lies about all that they have of it is one rectangle, which is quartered about
  /// a place that is known to shine.
  explicit BrightPlaces(std::span<const Box> boxes);

  bool empty() const { return by_pixel_.empty(); }
  /// Those in a pixel.
  std::span<const Rectangle> in(int i, int j) const;
  /// Calls `visit(i, j)` with the pixels that hold any, row by row.
  template <class Visit>
  void visit_pixels(const Visit& visit) const {
    for (const Pixel& pixel : pixels_) visit(pixel.i, pixel.j);
  }

 private:
  struct Pixel {
    int i, j;
  };
  std::vector<Pixel> pixels_;
  std::unordered_map<std::uint64_t, std::vector<Rectangle>> by_pixel_;
};

/// What of a pixel's response falls on bright places, and what is left.
struct BrightShares {
  struct Part {
    BrightPlaces::Rectangle where;  ///< within reach of the pixel's footprint
    std::vector<double> share;      ///< of the response, by group of columns
  };
  std::vector<Part> parts;
  std::vector<double> left;  ///< by group; 1 where there are no parts
  bool hold(FocalPoint point) const;
};

/// Of pixel (i, j). Of no parts where the problem knows no bright places.
BrightShares bright_shares(const TileProblem& problem, const ColumnFootprints& footprints, int i, int j);

/// Maps the unit square to a rectangle so that points lie as densely as a footprint has it about the centre of pixel (i, j), which is at
/// (i + 0.5, j + 0.5).
class BrightWarp {
 public:
  /// Keeps a reference.
  BrightWarp(const PixelFootprint& footprint, const BrightPlaces::Rectangle& where, int i, int j);
  /// `key`: of what else is drawn for the point.
  FocalPoint at(Point2 u, std::uint64_t key) const;

 private:
  static constexpr int kCells = 8;
  const PixelFootprint& footprint_;
  BrightPlaces::Rectangle where_;
  double x_, y_;
  std::vector<double> rows_, cells_;  // running sums: of rows; of the cells of each row
};

}  // namespace ifov::sampling
