#pragma once

#include <string>

#include "radiometry/spectrum.h"

namespace ifov::io {
struct Document;
struct SpectrumDocument;
}  // namespace ifov::io

namespace ifov::session {

/// Reads the files that a spectrum of the document names. `name` is what later messages call it.
radiometry::Spectrum assemble_spectrum(const io::Document& document, const io::SpectrumDocument& spectrum,
                                       const std::string& name);

}  // namespace ifov::session
