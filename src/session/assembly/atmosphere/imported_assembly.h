#pragma once

#include <memory>

#include "core/run_control.h"
#include "radiometry/spectral_nodes.h"
#include "session/assembly/atmosphere/atmosphere_subject.h"

namespace ifov::atmosphere {
class ImportedAtmosphere;
}

namespace ifov::io {
struct ImportedDocument;
struct LightDocument;
}  // namespace ifov::io

namespace ifov::session {

/// A document's imported runs as the channels of its sensor see them; `light` must leave to them what follows from
/// them. `surfaces` and `demands` as for radiometry::SpectralNodes::build. Throws InputError, at the place in the document.
std::unique_ptr<atmosphere::ImportedAtmosphere> assemble_imported(
    const io::ImportedDocument& written, const io::LightDocument& light, const AtmosphereSubject& subject,
    std::span<const radiometry::Spectrum> surfaces, radiometry::NodeDemands demands, LogSink* log);

}  // namespace ifov::session
