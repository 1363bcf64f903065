#include "io/document/detector_document.h"
#include "io/document/schema/schema_type.h"
#include "io/document/sensor_document.h"
#include "io/document/tables/tables.h"
#include "io/library/sensor_presets.h"

namespace ifov::io {
namespace {

SpectrumDocument radiance(double value, const SourcePosition& position) {
  return {ConstantSpectrum{value}, SpectrumOf::radiance, {}, OutsideRange::error, position};
}

ChannelDocument channel_of(const PresetBand& band, const SourcePosition& position) {
  ChannelDocument channel;
  channel.name = band.name;
  channel.position = position;
  if (band.is_bell)
    channel.response = GaussianChannel{band.a_um, band.b_um};
  else
    channel.response = TopHatChannel{band.a_um, band.b_um};
  if (band.snr > 0.0)
    channel.snr =
        std::make_shared<const SnrDocument>(SnrDocument{band.snr, radiance(band.at_w_m2_sr_um, position)});
  else if (band.at_k == PresetBand::kUsual_k)
    channel.noise_k = band.nedt_k;
  else if (band.nedt_k > 0.0)
    channel.noise = radiance(band.nedl_w_m2_sr_um(), position);
  return channel;
}

}  // namespace

SchemaType<std::vector<ChannelDocument>> preset_type() {
  return located<std::vector<ChannelDocument>>(
      label(),
      [](const std::string& name, const DocumentNode& node) {
        try {
          std::vector<ChannelDocument> channels;
          for (const PresetBand& band : sensor_preset(name).bands)
            channels.push_back(channel_of(band, node.position()));
          return channels;
        } catch (const InputError& error) {
          node.fail(error.what());
        }
      },
      [](const std::vector<ChannelDocument>&) { return std::optional<std::string>(); });
}

}  // namespace ifov::io
