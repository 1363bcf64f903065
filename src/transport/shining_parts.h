#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/surface_piece.h"
#include "geometry/surface_point.h"
#include "geometry/world/surface_survey.h"

namespace ifov::transport {

class SpectralScene;

/// What of a scene shines so much that its image in a mirror matters however small it is: pieces of surface, put together
/// into parts that fill the spheres about them.
class ShiningParts {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// A surface assignment belongs to them that may be so many times as bright as the rest (EmitterChoice) in some channel.
  static constexpr double kContrast = 3.0;
  /// Of more pieces, none are listed.
  static constexpr std::size_t kMost = 1 << 18;

  struct Part {
    geometry::SurfaceSurvey::Ball ball;
    double fill = 1.0;  ///< about the share of the ball's disc that it fills, above 0
    std::uint32_t object = 0;
    double contrast = 0.0;         ///< how many times as bright as the rest it may be
    std::uint32_t assignment = 0;  ///< the brightest of it
  };

  explicit ShiningParts(const SpectralScene& scene);

  /// By object.
  std::span<const Part> parts() const { return parts_; }
  /// Whether all that shines is listed: what lies on planes and height fields is large and is met.
  bool complete() const { return complete_; }
  /// The part that a ray met; kNone where it met none.
  std::uint32_t part_of(const geometry::SurfacePoint& hit) const;
  /// Whether what was met is of a surface assignment that may shine.
  bool shines(const geometry::SurfacePoint& hit) const { return wanted_[hit.material]; }
  bool wants(std::uint32_t assignment) const { return assignment < wanted_.size() && wanted_[assignment]; }
  /// What the rest shines with (EmitterChoice::usual()).
  std::span<const double> usual() const { return usual_; }
  /// What a surface assignment that shines emits at most, by channel, W m-2 sr-1 um-1.
  std::span<const double> highest(std::uint32_t assignment) const { return highest_[assignment]; }

 private:
  struct Name {
    std::uint32_t object, primitive, patch;
    friend auto operator<=>(const Name&, const Name&) = default;
  };
  /// A piece that is part of a part, or that several parts are cut from along `axis`.
  struct Entry {
    Name name{};
    std::uint32_t part = 0, count = 1;
    math::Point3 from;
    math::Vec3 axis{};  ///< its product with a place less `from` is the number of the part
  };
  struct Piece {
    geometry::SurfaceSurvey::Ball ball;
    double area_m2 = 0.0;
    std::size_t entry = 0;
  };
  void cut(const geometry::SurfacePiece& piece, Part part);
  void put_together(std::span<Piece> pieces, Part part);

  geometry::WantedMaterials wanted_;
  std::vector<double> usual_;
  std::vector<std::vector<double>> highest_;  // by surface assignment
  std::vector<Part> parts_;
  std::vector<Entry> entries_;  // sorted by name
  bool complete_ = true;
};

}  // namespace ifov::transport
