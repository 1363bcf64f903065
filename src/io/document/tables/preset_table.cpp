#include "io/document/detector_document.h"
#include "io/document/schema/schema_type.h"
#include "io/document/sensor_document.h"
#include "io/document/spectrometer_document.h"
#include "io/document/tables/spectrometer_tables.h"
#include "io/document/tables/tables.h"
#include "io/json/json_adapter.h"
#include "io/library/sensor_presets.h"

namespace ifov::io {
namespace {

void place(std::optional<SpectrumDocument>& spectrum, const SourcePosition& position) {
  if (spectrum) spectrum->position = position;
}

std::shared_ptr<const DetectorDocument> placed(DetectorDocument detector, const SourcePosition& position) {
  detector.position = position;
  place(detector.quantum_efficiency, position);
  if (detector.reference) place(detector.reference->radiance, position);
  return std::make_shared<const DetectorDocument>(std::move(detector));
}

/// What is wrong with it stands where the document names the preset.
ChannelDocument placed(ChannelDocument channel, const SourcePosition& position) {
  channel.position = position;
  place(channel.noise, position);
  if (channel.snr) {
    SnrDocument snr = *channel.snr;
    snr.radiance.position = position;
    channel.snr = std::make_shared<const SnrDocument>(std::move(snr));
  }
  if (channel.detector) channel.detector = placed(*channel.detector, position);
  return channel;
}

SensorDocument sensor_of(const SensorPreset& preset, const SourcePosition& position) {
  const DocumentTree tree = parse_json(preset_text(preset), "preset " + preset.name);
  const DocumentNode& written = tree.root->given("sensor");
  SensorDocument sensor;
  for (ChannelDocument& channel : channels_type().read(written.given("channels")))
    sensor.channels.push_back(placed(std::move(channel), position));
  if (const DocumentNode* node = written.find("optics")) {
    OpticsDocument optics = optics_type().read(*node);
    optics.position = position;
    place(optics.throughput, position), place(optics.emissivity, position);
    sensor.optics = std::make_shared<const OpticsDocument>(std::move(optics));
  }
  if (const DocumentNode* node = written.find("detector"))
    sensor.detector = placed(detector_type().read(*node), position);
  if (const DocumentNode* node = written.find("mosaic")) {
    MosaicDocument mosaic = mosaic_type().read(*node);
    mosaic.position = position;
    for (auto& row : mosaic.rows)
      for (DocumentName& name : row) name.position = position;
    sensor.mosaic = std::make_shared<const MosaicDocument>(std::move(mosaic));
  }
  return sensor;
}

}  // namespace

SchemaType<SensorDocument> preset_type() {
  return located<SensorDocument>(
      label(),
      [](const std::string& name, const DocumentNode& node) {
        const SensorPreset* preset = nullptr;
        try {
          preset = &sensor_preset(name);
        } catch (const InputError& error) {
          node.fail(error.what());
        }
        return sensor_of(*preset, node.position());
      },
      [](const SensorDocument&) { return std::optional<std::string>(); });
}

OpticsDocument OpticsDocument::under(const OpticsDocument& other) const {
  OpticsDocument both = other;
  if (!both.aperture_m && !both.focal_length_m && !both.f_number)
    both.aperture_m = aperture_m, both.focal_length_m = focal_length_m, both.f_number = f_number;
  if (both.obscuration == 0.0) both.obscuration = obscuration;
  if (!both.throughput) both.throughput = throughput;
  if (!both.temperature_k) both.temperature_k = temperature_k;
  if (!both.emissivity) both.emissivity = emissivity;
  if (!both.stray_light) both.stray_light = stray_light;
  if (!both.vignetting) both.vignetting = vignetting;
  return both;
}

}  // namespace ifov::io
