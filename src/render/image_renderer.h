#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/run_control.h"
#include "render/field/label_detail.h"
#include "render/tolerance/atmosphere_half_width.h"
#include "render/tolerance/node_half_width.h"
#include "transport/transport_options.h"

namespace ifov::sampling {
class FootprintGroups;
class PixelFootprint;
class PixelSampler;
}  // namespace ifov::sampling
namespace ifov::sensor {
class Camera;
class ColumnResponses;
class PsfWings;
}  // namespace ifov::sensor
namespace ifov::transport {
class SpectralScene;
}
namespace ifov::truth {
struct Collector;
}

namespace ifov::render {

class AccuracyTolerance;
class EarlierTiles;
struct Polarimetry;
class TileSink;
class TileSource;

/// All that an image depends on. Keeps references; they must outlive the job.
struct RenderJob {
  const transport::SpectralScene& scene;
  const sensor::Camera& camera;
  const sampling::PixelFootprint& footprint;
  const sampling::PixelSampler& sampler;
  const AccuracyTolerance* tolerance = nullptr;
  transport::TransportOptions transport{};
  LabelDetail label_detail = LabelDetail::sun_state;
  std::uint64_t seed = 1;
  int tile_px = 64;
  bool pilot_rays = true;                      ///< send a ray at each compact object smaller than a pixel
  std::vector<int> steering_channels{};        ///< channels that steer the sampler
  std::span<const AtmosphereHalfWidth> air{};  ///< by channel; empty: the air has no error that is known
  std::span<const NodeHalfWidth> nodes{};      ///< by channel; empty: not known, or in those of the air
  const sampling::FootprintGroups* groups =
      nullptr;  ///< of channels whose footprints differ; null: that one is of all
  std::vector<const sensor::PsfWings*> wings{};  ///< of the PSF, by group of footprints; empty: it has none
  /// By channel: share of the PSF's energy that is cut off and stands in no wings, or that its group's has elsewhere; empty: none.
  std::vector<double> cut{};
  /// By channel: radiance at most, W m-2 sr-1 um-1, of what outshines the scene, which is cut off, too; empty: nothing does.
  std::vector<double> outshining{};
  bool image_wide = false;     ///< the tolerance is of the image, not of each pixel
  bool keep_memory = false;    ///< tiles carry what a run at a tighter tolerance can go on from
  bool keep_variances = true;  ///< else tiles have half-widths alone, unless they are to be gone on from
  std::vector<const truth::Collector*> collectors{};  ///< of what tiles note beside radiance
  EarlierTiles* earlier = nullptr;                    ///< tiles of a run at a looser tolerance, to go on from
  const Polarimetry* polarimetry = nullptr;           ///< null: radiance alone
  bool emissivity = false;                            ///< tiles tell that of what is seen
  bool thermal_errors = false;                        ///< tiles tell what solved temperatures may be off by
  bool parts = false;                                 ///< tiles tell the parts that radiance is made of
  const sensor::ColumnResponses* responses = nullptr;  ///< null: channels are what paths carry

  /// Half the width of the widest footprint about its pixel's centre.
  double reach_px() const;
};

/// How the work is done; the result does not depend on it.
struct RenderControl {
  int threads = 0;
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;
  /// Positions in the tile grid, of all tiles or of those that are wanted; empty: all, row by row.
  std::span<const int> tile_order;
  TileSource* source = nullptr;  ///< where given, tiles come from it and not in an order
};

/// Renders tile by tile into the sink. A tile's result depends on the job and the tile alone. Throws Cancelled.
Progress render_image(const RenderJob& job, const RenderControl& control, TileSink& sink);

/// Channels that steer decisions: all of them up to `count`, else `count` spread evenly and those in `always`.
std::vector<int> steering_channels_of(int channels, std::span<const int> always, int count = 16);

}  // namespace ifov::render
