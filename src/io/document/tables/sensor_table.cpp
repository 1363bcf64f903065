#include "core/format.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/detector_document.h"
#include "io/document/schema/record.h"
#include "io/document/schema/shared_target.h"
#include "io/document/sensor_document.h"
#include "io/document/spectrometer_document.h"
#include "io/document/tables/sensor_tables.h"
#include "io/document/tables/spectrometer_tables.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

/// A sensor of single views in place of a camera.
template <class Settings>
void add_views(Record<SensorDocument>& record, const char* key, const SchemaType<Settings>& type,
               std::string doc) {
  using Placed = std::pair<Settings, SourcePosition>;
  const auto placed = located<Placed>(
      type,
      [](Settings settings, const DocumentNode& node) {
        return Placed(std::move(settings), node.key_position());
      },
      [](const Placed& settings) { return settings.first; });
  record.one(key,
             via(
                 [key](SensorDocument& sensor, Placed settings) {
                   sensor.camera.model = key;
                   sensor.camera.settings = std::make_shared<const Settings>(std::move(settings.first));
                   sensor.camera.position = std::move(settings.second);
                 },
                 [](const SensorDocument& sensor) {
                   const auto* settings = camera_as<Settings>(sensor.camera);
                   return settings != nullptr ? std::optional(Placed(*settings, {})) : std::nullopt;
                 }),
             placed, std::move(doc));
}

/// Where a row puts what counts before the same of a preset, key by key.
template <class V>
auto over_preset(std::shared_ptr<const V> SensorDocument::*member) {
  return via(
      [member](SensorDocument& sensor, V value) {
        const std::shared_ptr<const V> preset = sensor.*member;
        sensor.*member = std::make_shared<const V>(preset ? preset->under(value) : std::move(value));
      },
      [member](const SensorDocument& sensor) { return (sensor.*member).get(); });
}

/// What an image's pixels alone have.
void refuse_for_views(const SensorDocument& sensor, const DocumentNode& node) {
  if (dynamic_cast<const ViewSettings*>(sensor.camera.settings.get()) == nullptr) return;
  for (const char* key :
       {"mount", "psf", "stokes", "fill_factor", "optics", "detector", "smile", "keystone", "mosaic"})
    if (const DocumentNode* own = node.find(key))
      own->fail_at_key(
          format("'{}' is of the pixels of a picture, and '{}' makes none", key, sensor.camera.model));
  for (const ChannelDocument& channel : sensor.channels)
    if (channel.shift_px || channel.smile || channel.keystone)
      node.given("channels")
          .fail_at_key(format(
              "channel '{}' has a {}, which is of the pixels of a picture, and '{}' makes none", channel.name,
              channel.shift_px ? "shift"
              : channel.smile  ? "smile"
                               : "keystone",
              sensor.camera.model));
  for (const ChannelDocument& channel : sensor.channels)
    if (channel.polarizer || channel.retarder)
      node.given("channels")
          .fail_at_key(format(
              "channel '{}' has a polarizer or retarder, which are turned about the axes of a picture, and '{}' makes none",
              channel.name, sensor.camera.model));
}

}  // namespace

SchemaType<SensorDocument> sensor_type() {
  Record<SensorDocument> record("sensor", "What measures.");
  record.exactly_one().one("camera", &SensorDocument::camera, camera_type(), "geometry of the image");
  add_views(record, "distant", distant_type(),
            "instead of an image: what leaves an area towards a list of directions");
  add_views(record, "hemisphere", hemisphere_type(),
            "instead: towards directions all over the hemisphere, and the albedo");
  add_views(record, "points", points_type(), "instead: irradiance and sky view at points");
  add_views(record, "rays", rays_type(), "instead: radiance along rays");
  add_own_mounts(record);
  record.exactly_one()
      .one("channels", &SensorDocument::channels, channels_type(), "spectral channels")
      .one(
          "preset", only_read([](SensorDocument& sensor, SensorDocument preset) {
            sensor.channels = std::move(preset.channels);
            sensor.optics = std::move(preset.optics), sensor.detector = std::move(preset.detector);
            sensor.mosaic = std::move(preset.mosaic);
          }),
          preset_type(),
          "instead: the channels of an instrument and their noise, its optics, detector and mosaic as far as they are published; what the document "
          "says of these counts before them. `ifov sensors` lists the instruments")
      .optional(
          "psf",
          via(
              [](SensorDocument& sensor, PlacedPsf psf) {
                sensor.psf = psf.parts.empty()
                                 ? nullptr
                                 : std::make_shared<const PsfDocument>(PsfDocument{std::move(psf.parts)});
                sensor.psf_position = std::move(psf.position);
              },
              [](const SensorDocument& sensor) {
                return sensor.psf ? std::optional(PlacedPsf{sensor.psf->parts, {}}) : std::nullopt;
              }),
          psf_type(),
          "blur of the optics and of the detector, or a list of what blurs one after the other; none if not given")
      .with_default(
          "stokes", &SensorDocument::stokes, boolean(), "false",
          "whether the Stokes vector of light is told, about the axes of the focal plane: products `stokes`, `dolp`, `aop` and "
          "their errors")
      .with_default(
          "fill_factor", &SensorDocument::fill_factor, fraction({0.0, 16.0, true, false, {}}), "1",
          "sensitive area of a detector element over that of its pitch, a centred square; more than 1: neighbours overlap")
      .optional("optics", over_preset(&SensorDocument::optics), optics_type(),
                "what light passes, for a `detector`")
      .optional("detector", over_preset(&SensorDocument::detector), detector_type(),
                "how light becomes electrons and counts: for `ifov detect`, and errors in shares of noise")
      .optional(
          "smile", shared(&SensorDocument::smile), smile_type(true),
          "how the channels' responses differ from detector column to detector column; not at all if not given")
      .optional(
          "keystone", shared(&SensorDocument::keystone), keystone_type(true),
          "how far across the track what elements see lies from them, by channel and detector column; nowhere if not given")
      .optional(
          "mosaic", shared(&SensorDocument::mosaic), mosaic_type(),
          "filters on the elements of a frame, each of which sees one channel: rows of channels' names, a pattern that repeats from "
          "the upper left element on, such as [[\"red\", \"green\"], [\"green\", \"blue\"]]")
      .check(refuse_for_views);
  return record.type();
}

}  // namespace ifov::io
