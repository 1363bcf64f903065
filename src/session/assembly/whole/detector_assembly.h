#pragma once

#include <span>
#include <vector>

#include "sensor/detector/detector.h"
#include "sensor/detector/element_light.h"

namespace ifov::io {
struct DocumentSources;
struct SensorDocument;
}  // namespace ifov::io
namespace ifov::radiometry {
struct Channel;
}

namespace ifov::session {

/// What a channel's detector is.
struct ChannelDetector {
  sensor::Detector figures;  ///< does not exist() where neither sensor nor channel have a 'detector'
  sensor::ElementOptics optics;
  double photons_per_radiance = 0.0;  ///< as electrons_per_radiance with a quantum efficiency of 1
  double reference_w_m2_sr_um = 0.0;  ///< the radiance for which noise is told as one number
  double lag = 0.0, inertia = 0.0;    ///< shares of sensor::SignalMemory, also beside a noise that is stated
};

/// Of every channel. InputError, located, where optics and detector contradict themselves, each other or the camera, lack what light
/// takes to become electrons, cannot hold what they are to hold, or stand beside a noise that is stated.
std::vector<ChannelDetector> assemble_detectors(const io::DocumentSources& sources,
                                                const io::SensorDocument& sensor,
                                                std::span<const radiometry::Channel> channels);

}  // namespace ifov::session
