#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "render/flown_pilots.h"
#include "render/parts/light_told.h"
#include "render/unsampled_light.h"
#include "sampling/image/survey.h"
#include "sampling/tile.h"
#include "transport/transport_options.h"

namespace ifov::render {

class SceneField;
struct RenderControl;
struct RenderJob;

/// A job's camera's whole image, with what is found out about it once: from there tiles can be rendered one by one.
class Picture {
 public:
  /// Keeps references to the job. Throws Cancelled.
  Picture(const RenderJob& job, const RenderControl& control);
  ~Picture();

  /// One tile, of a number among the job's earlier tiles. From any thread. Throws Cancelled.
  sampling::TileResult tile(const sampling::PixelRect& tile, std::size_t number) const;
  /// The same by way of a field() that no other tile had.
  sampling::TileResult tile(const sampling::PixelRect& tile, std::size_t number, SceneField& field) const;
  std::unique_ptr<SceneField> field() const;
  std::unique_ptr<SceneField> tracer() const;  ///< the same, for paths whose light others make

  /// Of rays that belong to no tile.
  const sampling::RayCounts& rays() const { return rays_; }

 private:
  sampling::TileProblem problem_of(const sampling::PixelRect& tile) const;
  void find_wings();
  void find_pilots();
  void find_bright_places();
  /// Directions in which the sensor would see the Sun.
  std::vector<math::Vec3> glare() const;
  /// Those near a tile; the field is told where what is small is when.
  PilotRays::Near pilots_near(const sampling::PixelRect& tile, SceneField& field) const;

  const RenderJob& job_;
  const CancelToken* cancel_;
  const double margin_px_;
  const LightTold told_;
  const UnsampledLight unsampled_;
  transport::TransportOptions transport_;
  std::optional<PilotRays> pilot_rays_;
  FlownPilots flown_pilots_{{}};                                 // of a camera that moves while it is exposed
  std::unique_ptr<const sampling::BrightPlaces> bright_places_;  // null: none are known
  std::vector<int> steering_channels_;
  std::vector<float> sky_shares_;
  std::unique_ptr<const sampling::ImageSurvey> survey_;
  std::optional<WingSpots> wing_spots_;
  std::optional<SpotLight> spot_light_;
  sampling::RayCounts rays_;
};

}  // namespace ifov::render
