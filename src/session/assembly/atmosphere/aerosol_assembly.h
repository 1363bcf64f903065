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
/// What its own haze does to polarization, for people.
std::string haze_polarization(const io::AerosolDocument& written);
/// Whether any of its aerosol, of the tables or its own, is of this type.
bool has_aerosol_of(const io::AerosolDocument& written, const std::string& type);

}  // namespace ifov::session
