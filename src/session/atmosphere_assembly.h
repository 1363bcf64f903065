#pragma once

#include <memory>

#include "atmosphere/sensor/sensor_atmosphere.h"
#include "core/run_control.h"
#include "session/parts.h"

namespace ifov::session {

/// The document's modelled atmosphere as the channels of its sensor see it from its camera. `surfaces` and `demands`
/// as for radiometry::SpectralNodes::build. Throws InputError, at the place in the document.
std::unique_ptr<atmosphere::SensorAtmosphere> assemble_atmosphere(const Session::Parts& parts,
                                                                  std::span<const radiometry::Spectrum> surfaces,
                                                                  radiometry::NodeDemands demands, int threads,
                                                                  LogSink* log);

}  // namespace ifov::session
