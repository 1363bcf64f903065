#pragma once

#include <string>

namespace ifov::atmosphere {
struct AerosolDescription;
}
namespace ifov::io {
struct AerosolDocument;
struct DocumentSources;
}  // namespace ifov::io

namespace ifov::session {

/// A document's haze, with the files that it names read. Throws InputError, at the place in the document.
atmosphere::AerosolDescription assemble_aerosol(const io::DocumentSources& sources,
                                                const io::AerosolDocument& written);

/// What a document says of its own haze, for people (empty: it has none): "depth 0.3 at 0.55 um, ..., from the ground up over 2 km".
std::string haze_statement(const io::AerosolDocument& written);
/// Whether all of it polarizes the light that it scatters, by Mie's theory.
bool is_of_spheres(const io::AerosolDocument& written);

}  // namespace ifov::session
