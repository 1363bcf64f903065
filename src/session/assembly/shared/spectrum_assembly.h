#pragma once

#include <string>

#include "radiometry/spectrum.h"

namespace ifov::io {
struct DocumentSources;
struct SpectrumDocument;
}  // namespace ifov::io

namespace ifov::session {

/// Reads the files that a spectrum of a document names. `name` is what later messages call it.
radiometry::Spectrum assemble_spectrum(const io::DocumentSources& sources,
                                       const io::SpectrumDocument& spectrum, const std::string& name);

}  // namespace ifov::session
