#pragma once

#include <vector>

#include "transport/path_record.h"

namespace ifov::sampling {
struct LaterLight;
struct TileResult;
}  // namespace ifov::sampling
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::render {

class AccuracyTolerance;

/// Sunlight that may arrive by ways that are not sought: by mirrors that bend onto other surfaces (caustics), by more
/// flat mirrors in turn than are sought, and by several mirrors to the sensor of which one bends. How much is told
/// by paths that find a wider Sun (transport::WideSun): in a column of its own behind all
/// others, in parts of the Sun's irradiance (1/sr), in the node where most comes back. It marks pixels; it never enters
/// a radiance.
class UnseenLight {
 public:
  /// Takes a column only where such ways exist. `column` is the first that is free.
  UnseenLight(const transport::SpectralScene& scene, int column);

  int count() const { return count_; }
  void write(const transport::PathRecord::Path& path, float* columns) const {
    if (count_ > 0) columns[column_] = path.unseen;
  }

  /// The estimate comes from few rays, and light that is gathered may be more than it: on the far side of a ball
  /// 2.8 times were seen, which the half-width with twice the estimate holds but for a part of itself.
  static constexpr double kCaution = 2.0;
  /// Less than this share of what was asked for is left alone.
  static constexpr double kNegligible = 0.1;
  /// Widens the half-widths of a finished tile, its columns still whole, by kCaution times what may arrive, in the pixel
  /// or in the mean of its neighbourhood in the tile; pixels that become wider than was asked for get
  /// Reason::unseen_light. Nothing without a tolerance. `later`: what will join them; may be null.
  void settle(const AccuracyTolerance* tolerance, const sampling::LaterLight* later,
              sampling::TileResult& tile) const;

 private:
  int column_, count_ = 0;
  std::vector<double> sunlight_;  // by channel: the Sun's irradiance through the view path
};

}  // namespace ifov::render
