#include "session/preview_document.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "io/document/cameras/camera_settings.h"
#include "io/document/document.h"
#include "io/document/samplers/plain_sampling.h"
#include "io/product_parts/product_headers.h"
#include "render/image_info.h"
#include "session/assembly/whole/sensor_assembly.h"

namespace ifov::session {
namespace {

std::vector<io::ChannelDocument> shown_channels(const io::Document& document) {
  const std::vector<io::ChannelDocument>& all = document.sensor.channels;
  std::vector<io::ChannelDocument> shown;
  for (const io::DocumentName& named : document.output.quicklook_channels)
    for (const io::ChannelDocument& channel : all)
      if (channel.name == named.name) shown.push_back(channel);
  if (!shown.empty()) return shown;
  render::ImageInfo info;
  for (const radiometry::Channel& channel : assemble_channels(document.sources, document.sensor.channels))
    info.channels.push_back({channel.name, channel.centre_um, channel.fwhm_um});
  for (const int c : io::picture_channels(info)) shown.push_back(all[static_cast<std::size_t>(c)]);
  return shown;
}

}  // namespace

io::Document for_preview(io::Document document, int longest_px) {
  const auto any_channel = [&](const auto& has) {
    return std::any_of(document.sensor.channels.begin(), document.sensor.channels.end(), has);
  };
  if (document.sensor.smile ||
      any_channel([](const io::ChannelDocument& channel) { return bool(channel.smile); }))
    document.left_out.emplace_back("smile");
  if (document.sensor.keystone ||
      any_channel([](const io::ChannelDocument& channel) { return bool(channel.keystone); }))
    document.left_out.emplace_back("keystone");
  if (document.sensor.mosaic) document.left_out.emplace_back("mosaic");
  document.sensor.channels = shown_channels(document);
  document.sensor.psf.reset();
  document.sensor.optics.reset(), document.sensor.detector.reset();
  document.sensor.smile.reset(), document.sensor.keystone.reset(), document.sensor.mosaic.reset();
  for (io::ChannelDocument& channel : document.sensor.channels)
    channel.detector.reset(), channel.smile.reset(), channel.keystone.reset();
  document.sampling.method = std::make_shared<const io::SingleSampling>();
  document.sensor.camera.settings = document.sensor.camera.settings->shrunk(longest_px);
  return document;
}

}  // namespace ifov::session
