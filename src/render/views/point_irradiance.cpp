#include "render/views/point_irradiance.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/tile.h"
#include "sensor/single_views.h"

namespace ifov::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUsualError = 1e-3;  // of the Sun's irradiance, where nothing is asked
constexpr double kShareOfLimit = 0.25;

/// Means and limits of the radiance of a white Lambertian surface.
class White {
 public:
  White(const sampling::TileResult& tile, const std::vector<double>& sunlight,
        const AccuracyTolerance* tolerance)
      : mean(tile.mean.size()),
        limit(mean.size(), 0.0),
        tile_(tile),
        sunlight_(sunlight),
        tolerance_(tolerance) {}

  /// Under this share of the Sun.
  void light(double cosine) {
    for (std::size_t c = 0; c < mean.size(); ++c)
      mean[c] = static_cast<double>(tile_.mean[c]) + cosine * sunlight_[c] / kPi;
    if (tolerance_ != nullptr) tolerance_->asked(mean, limit);
  }
  /// How far the share may be off.
  double error() const {
    if (tolerance_ == nullptr) return kUsualError;
    double least = 1.0;
    for (std::size_t c = 0; c < mean.size(); ++c)
      if (sunlight_[c] > 0.0) least = std::min(least, kShareOfLimit * kPi * limit[c] / sunlight_[c]);
    return least;
  }

  std::vector<double> mean, limit;

 private:
  const sampling::TileResult& tile_;
  const std::vector<double>& sunlight_;
  const AccuracyTolerance* tolerance_;
};

}  // namespace

void to_irradiance(const transport::SpectralScene& scene, const sensor::SingleView& view,
                   const AccuracyTolerance* tolerance, const ThroughPanes& through_panes, std::uint64_t seed,
                   sampling::TileResult& tile) {
  const std::vector<double> sunlight = sunlight_by_channel(scene);
  const math::Ray along = view.middle_ray();
  const double confidence = tolerance != nullptr ? tolerance->confidence() : 0.95;
  White white(tile, sunlight, tolerance);
  white.light(sun_cosine(scene, along));
  SunShare share = share_of_sun(scene, along, through_panes, white.error(), confidence, seed, tile.rays);
  white.light(share.cosine);
  // In the shade less is left to the Sun's error than in its light.
  if (share.half_width > white.error()) {
    share = share_of_sun(scene, along, through_panes, white.error(), confidence, seed, tile.rays);
    white.light(share.cosine);
  }
  double worst = 0.0;
  for (std::size_t c = 0; c < sunlight.size(); ++c) {
    tile.mean[c] = static_cast<float>(kPi * white.mean[c]);
    if (!tile.has_errors()) continue;
    if (!tile.variance_path.empty()) {
      const double sun = share.standard_error * sunlight[c];
      tile.variance_geometry[c] =
          static_cast<float>(kPi * kPi * static_cast<double>(tile.variance_geometry[c]) + sun * sun);
      tile.variance_path[c] = static_cast<float>(kPi * kPi * static_cast<double>(tile.variance_path[c]));
    }
    const double half_width =
        kPi * static_cast<double>(tile.half_width[c]) + (share.half_width + share.unfound) * sunlight[c];
    tile.half_width[c] = static_cast<float>(half_width);
    if (tolerance != nullptr) worst = std::max(worst, half_width / (kPi * white.limit[c]));
  }
  if (tolerance == nullptr || tile.worst_ratio.empty()) return;
  constexpr double kRounding = 1e-5;
  tile.worst_ratio[0] = static_cast<float>(worst);
  if (worst > 1.0 + kRounding)
    tile.set(0, share.unfound > 0.0 ? sampling::Reason::unseen_light : sampling::Reason::error);
}

}  // namespace ifov::render
