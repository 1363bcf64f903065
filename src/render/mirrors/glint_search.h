#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "geometry/world/surface_survey.h"
#include "sampling/field.h"

namespace ifov::sensor {
class Camera;
}

namespace ifov::render {

/// A point of a mirror that may show the Sun, or what is sought, to the sensor, before anything is known of what stands between.
struct GlintPoint {
  math::Point3 at_m;
  sampling::FocalPoint image;
  double area = 0.0;  ///< of the focal plane that it stands for, px2; under a point Sun px2 per steradian
  std::uint32_t replicate = 0;  ///< of the points, 0 to GlintSearch::kReplicates - 1
};

/// Finds where on the focal plane curved mirrors show the Sun. A surface is divided into triangles of its two
/// parameters as long as light that is reflected from the corners to the sensor comes from directions farther apart
/// than a fraction of the Sun's disc, and as long as it may come from the disc; each triangle that is left is an area
/// of the focal plane and gets one random point for each replicate. Under a point Sun Newton's method finds
/// the point of the triangle that shows it, which stands for |det dp/dw| px2 sr-1: p on the focal plane, w the
/// direction that light comes from. The same is done for a ball in place of the disc: there the directions are those
/// relative to its centre's, which change along the surface.
class GlintSearch {
 public:
  static constexpr std::uint32_t kReplicates = 8;

  /// `margin_px` about the image within which glints matter; `steps` across the Sun's half-angle.
  GlintSearch(const sensor::Camera& camera, math::Vec3 towards_sun, double half_angle_rad, double margin_px,
              int steps, std::uint64_t seed);

  /// For a ball. More triangles than `most` are not made.
  GlintSearch(const sensor::Camera& camera, const geometry::SurfaceSurvey::Ball& ball, double margin_px,
              double steps, std::uint64_t seed, std::size_t most);

  /// How much wider triangles of highlights are than usual: all of them, and those far from the highlight's middle, by the share
  /// of the distance over the lobe's width.
  struct Coarseness {
    double all = 1.0, tail = 0.0;
  };
  /// More triangles than `most` are not made. For the highlights of lobes whose micro-facets have these slopes, in place of mirrors: there is no border within which a
  /// highlight lies; triangles are finer the nearer their directions are to the Sun, and all are left that come nearer than
  /// `reach_rad`.
  GlintSearch(const sensor::Camera& camera, math::Vec3 towards_sun, double least_slope, double reach_rad,
              const Coarseness& coarseness, double margin_px, std::uint64_t seed, std::size_t most);

  /// Whether there were more triangles than were to be made; those that were lie anywhere.
  bool broken_off() const { return broken_off_; }

  /// Calls back with the points of one surface. `number` tells surfaces apart. An empty callback: triangles are made, and no points.
  using Found = std::function<void(const GlintPoint&)>;
  void search(const geometry::SurfaceSurvey::Round& round, std::uint64_t number, const Found& found);
  void search(const geometry::SurfaceSurvey::Smooth& smooth, std::uint64_t number, const Found& found);
  /// For a ball in a plane of mirrors, normal . p = offset_m, its edges not minded.
  void search(math::Vec3 normal, double offset_m, std::uint64_t number, const Found& found);

 private:
  /// A surface by two parameters.
  using Surface = std::function<void(double u, double v, math::Point3& at, math::Vec3& normal)>;
  struct Corner {
    double u = 0.0, v = 0.0;
    math::Point3 at;
    math::Vec3 from;    ///< where light comes from that the surface reflects to the sensor
    math::Vec3 off;     ///< the same, relative to the ball's centre
    double wide = 0.0;  ///< half-angle of what is sought, rad
    sampling::FocalPoint image;
    bool seen = false;
  };
  struct Cell {
    Corner corner[3];
    int depth = 0;
  };
  Corner corner(const Surface& surface, double u, double v) const;
  /// s and t from corner 0 towards the others.
  Corner within(const Surface& surface, const Cell& cell, double s, double t) const;
  /// Of the whole triangle's image, px2, as if it were everywhere as at a point of it.
  double area_at(const Surface& surface, const Cell& cell, double s, double t, const Corner& here) const;
  void divide(const Surface& surface, const Cell& whole, std::uint64_t number, const Found& found);
  void divide_quad(const Surface& surface, double u0, double v0, double u1, double v1, std::uint64_t number,
                   const Found& found);
  void draw(const Surface& surface, const Cell& cell, std::uint64_t number, const Found& found);
  void solve(const Surface& surface, const Cell& cell, const Found& found);

  bool shows(const Corner& corner) const;

  const sensor::Camera& camera_;
  std::optional<geometry::SurfaceSurvey::Ball> ball_;
  math::Vec3 towards_sun_{}, first_{}, second_{};
  double half_angle_ = 0.0, margin_, step_;
  double growth_ = 0.0, tail_ = 0.0;  // of the steps of lobes: over the distance, and over its square
  bool lobes_ = false;
  double steps_ = 0.0;  // across a ball's half-angle
  std::size_t most_ = ~std::size_t{0};
  std::uint64_t seed_, drawn_ = 0;
  double least_part_ =
      0.0;  // of parameters' differences: triangles of less that are seen in part are left away
  bool broken_off_ = false;
  std::vector<Cell> cells_;
  std::vector<math::Point3> solved_;  // of this surface
};

}  // namespace ifov::render
