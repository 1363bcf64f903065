#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "math/vec3.h"
#include "sampling/field.h"
#include "sampling/pixel_rect.h"

namespace ifov {
class CancelToken;
}
namespace ifov::sensor {
class Camera;
}
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

/// Where in the image a thing may be that outshines the scene and that the paths of the wings' cells miss: boxes about the
/// images of transport::ShiningParts, cut where they are large. They may overlap; of a place the first counts that holds it.
class WingSpots {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// Larger boxes are cut: where the PSF falls off, their light is that of their middle.
  static constexpr double kLargest_px = 0.5;
  /// What is larger is met by the paths of cells.
  static constexpr double kMet_px = 16.0;
  /// Of more, those that shine least are left to the cells.
  static constexpr std::size_t kMost = std::size_t{1} << 16;

  struct Box {
    sampling::FocalPoint centre;
    double half_width_px, half_height_px;
    int across = 8;  ///< paths along a side, even
    /// About how much light may come from it.
    double strength = 0.0;
    /// Where something is known to shine in it, however small.
    std::optional<sampling::FocalPoint> brightest{};
    bool holds(sampling::FocalPoint p) const {
      return p.x_px >= centre.x_px - half_width_px && p.x_px < centre.x_px + half_width_px &&
             p.y_px >= centre.y_px - half_height_px && p.y_px < centre.y_px + half_height_px;
    }
    double area_px2() const { return 4.0 * half_width_px * half_height_px; }
  };

  explicit WingSpots(std::vector<Box> boxes);
  /// What is farther outside the picture is left to the cells.
  static constexpr double kOutside_px = 192.0;

  /// Of none where nothing outshines the scene. `others`: where mirrors and maps show such things.
  static WingSpots find(const transport::SpectralScene& scene, const sensor::Camera& camera,
                        std::vector<Box> others);

  /// The box of a ball's image; none where that is not in the picture's plane, or farther outside than kOutside_px.
  static std::optional<Box> about(math::Point3 centre_m, double radius_m, const sensor::Camera& camera);

  const std::vector<Box>& boxes() const { return boxes_; }
  /// The number of the first box that holds a point.
  std::uint32_t first_at(sampling::FocalPoint point) const;

 private:
  std::vector<Box> boxes_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_pixel_;  // ascending
};

/// What paths find in the boxes: once for all tiles.
class SpotLight {
 public:
  /// Keeps a reference to `where`. Throws Cancelled.
  SpotLight(const WingSpots& where, std::uint64_t seed, const CancelToken* cancel, sampling::Field& field);

  struct Spot {
    sampling::FocalPoint middle;  ///< of its light
    double area_px2 = 0.0;        ///< of what of it is in no box before
    std::vector<float> light;     ///< by column: integral over that area
    std::vector<float> variance;
    /// By column, in absolute value: what may be of something that is known to be there and that no path met; empty: nothing.
    std::vector<float> unmet;
  };
  /// Light that paths leave out, which is over what is seen where it stands: of no area.
  void add(std::vector<Spot> apart);
  const std::vector<Spot>& spots() const { return spots_; }
  const WingSpots& where() const { return where_; }

 private:
  std::vector<float> unmet(std::uint32_t number, std::span<const float> met, double area_px2,
                           std::uint64_t seed, sampling::Field& field) const;
  const WingSpots& where_;
  std::vector<Spot> spots_;
};

}  // namespace ifov::render
