#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiometry/channel.h"
#include "render/image_info.h"
#include "render/tolerance/atmosphere_half_width.h"
#include "render/tolerance/node_half_width.h"
#include "scene/scene.h"
#include "session/assembly/geometry/placed_objects.h"
#include "session/assembly/whole/sampling_assembly.h"
#include "session/loaded/temperature_errors.h"

namespace ifov::atmosphere {
class ImportedAtmosphere;
class SensorAtmosphere;
class WeatherSeries;
}  // namespace ifov::atmosphere
namespace ifov::io {
struct Document;
struct FileStamp;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::radiometry {
class SpectralNodes;
}
namespace ifov::render {
class AccuracyTolerance;
class ChannelBrightness;
struct Polarimetry;
struct RenderJob;
}  // namespace ifov::render
namespace ifov::sampling {
class FootprintGroups;
class PixelFootprint;
}  // namespace ifov::sampling
namespace ifov::sensor {
class Camera;
class PsfWings;
}  // namespace ifov::sensor
namespace ifov::transport {
class SpectralScene;
}

namespace ifov::session {

struct ColourGuess;
struct MapScale;

/// What a loaded document consists of. Immutable once loaded; members refer to those above them.
struct Parts {
  explicit Parts(const io::Document& of);
  ~Parts();

  const std::unique_ptr<const io::Document> kept_document;
  const io::Document& document;
  scene::Scene scene;
  std::vector<MapScale> map_scales;
  std::vector<ColourGuess> colour_guesses;
  PlacedObjects placed;
  math::Vec3 map_offset_m;                 ///< map coordinates of the scene's origin
  std::vector<io::FileStamp> known_files;  ///< files whose bytes the scene cache vouches for
  std::shared_ptr<const atmosphere::WeatherSeries> weather;
  std::optional<TemperatureErrors> temperature_errors;       ///< none where no temperature is solved
  std::vector<radiometry::Channel> told_channels;            ///< those of the document
  std::shared_ptr<const sensor::ColumnResponses> responses;  ///< by detector column; null: alike in all
  double most_spread = 1.0;                                  ///< theirs
  std::vector<radiometry::Channel> channels;         ///< those, or what they are sums of: carried by paths
  std::unique_ptr<const io::SensorDocument> sensor;  ///< of the document, with `channels` in place of its own
  std::vector<std::vector<double>> keystone_px;      ///< by document's channel and column; empty: nowhere
  std::shared_ptr<const render::Polarimetry>
      polarimetry;  ///< what the sensor does with it; null: radiance alone
  std::unique_ptr<sensor::Camera> camera;
  std::string assumed_surroundings;  ///< what they were taken to be where none are declared; empty: nothing
  std::string ground_in_air;         ///< what of the ground lights a modelled atmosphere; empty without one
  std::shared_ptr<atmosphere::SensorAtmosphere> atmosphere;  ///< null without a modelled one
  std::unique_ptr<atmosphere::ImportedAtmosphere> imported;  ///< null without imported runs
  std::unique_ptr<radiometry::SpectralNodes> own_nodes;      ///< null with either
  const radiometry::SpectralNodes* nodes = nullptr;
  std::unique_ptr<sampling::PixelFootprint> footprint;
  std::shared_ptr<const sampling::FootprintGroups> groups;  ///< of channels that differ; null: none do
  std::vector<std::unique_ptr<sensor::PsfWings>> wings;     ///< by group; empty where the PSF has none
  /// By channel: share of the PSF's energy that stands in no footprint and no wings, or elsewhere; the most that outshines the scene; or empty.
  std::vector<double> psf_cut, outshining;
  std::unique_ptr<transport::SpectralScene> spectral_scene;
  std::unique_ptr<render::ChannelBrightness> brightness;
  std::vector<render::AtmosphereHalfWidth> air;    ///< by channel; empty without a modelled atmosphere
  std::vector<render::NodeHalfWidth> node_errors;  ///< by channel; empty with a modelled one that holds them
  SamplingPlan plan;
  std::unique_ptr<render::AccuracyTolerance> tolerance;  ///< null where no accuracy is asked for
  render::ImageInfo info;
  std::vector<std::string> locations;  ///< where things are and what some rays see, lines for people
  std::vector<std::string> warnings;   ///< all that were given while the document was loaded

  std::size_t told_channel(std::size_t carried) const;  ///< that one of `channels` is of
  /// Whether light comes from above the horizon beside the Sun's: of the scene's own sky, or of its air.
  bool has_sky() const;
  render::RenderJob job() const;  ///< that renders the document's image
  /// The same image sampled in another way; keeps references to both.
  render::RenderJob job(const SamplingPlan& sampling, const render::AccuracyTolerance* limits) const;
  /// What a plan's accuracy asks for; null where it asks for none.
  std::unique_ptr<render::AccuracyTolerance> tolerance_of(const SamplingPlan& sampling) const;
  void make_tolerance();  ///< of its own plan
};

}  // namespace ifov::session
