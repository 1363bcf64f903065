#include "session/assembly/whole/noise_assembly.h"

#include <memory>

#include "io/document/detector_document.h"
#include "io/document/sensor_document.h"
#include "render/image_info.h"
#include "session/assembly/shared/spectrum_assembly.h"
#include "session/assembly/shared/with_position.h"
#include "session/assembly/whole/detector_assembly.h"

namespace ifov::session {
namespace {

double stated_noise(const io::DocumentSources& sources, const io::ChannelDocument& source,
                    const radiometry::Channel& channel) {
  constexpr double kWarm_k = 300.0;
  const auto at_centre = [&](const io::SpectrumDocument& spectrum, const char* name) {
    return with_position(sources, source.position,
                         [&] { return assemble_spectrum(sources, spectrum, name).at(channel.centre_um); });
  };
  if (source.noise) return at_centre(*source.noise, "noise");
  if (source.noise_k)
    return *source.noise_k * radiometry::channel_planck_slope_w_m2_sr_um_k(channel, kWarm_k);
  if (source.snr) return at_centre(source.snr->radiance, "radiance") / source.snr->ratio;
  return 0.0;
}

}  // namespace

std::vector<double> assemble_noise(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                                   const std::vector<radiometry::Channel>& channels) {
  std::vector<render::ChannelInfo> told(channels.size());
  tell_noise(sources, sensor, channels, told);
  std::vector<double> noise;
  for (const render::ChannelInfo& one : told) noise.push_back(one.noise);
  return noise;
}

void tell_noise(const io::DocumentSources& sources, const io::SensorDocument& sensor,
                const std::vector<radiometry::Channel>& channels, std::span<render::ChannelInfo> of) {
  const std::vector<ChannelDetector> detectors = assemble_detectors(sources, sensor, channels);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const sensor::Detector& detector = detectors[c].figures;
    of[c].lag = detectors[c].lag, of[c].inertia = detectors[c].inertia;
    if (detector.exists()) {
      of[c].detector = std::make_shared<const sensor::Detector>(detector);
      of[c].noise = detector.noise_w_m2_sr_um(detectors[c].reference_w_m2_sr_um);
    } else {
      of[c].noise = stated_noise(sources, sensor.channels[c], channels[c]);
    }
  }
}

}  // namespace ifov::session
