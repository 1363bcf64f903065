#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "radiometry/channel.h"

namespace ifov::atmosphere {
struct GasTermTable;
struct ProfileDescription;
}  // namespace ifov::atmosphere
namespace ifov::io {
struct ChannelDocument;
struct DocumentSources;
struct ModelledAtmosphere;
}  // namespace ifov::io

namespace ifov::session {

/// The terms of the document's gas model, for its air; null where it names none. Throws InputError, at the place in the document.
std::shared_ptr<const atmosphere::GasTermTable> assemble_gas_model(
    const io::DocumentSources& sources, const io::ModelledAtmosphere& air,
    const atmosphere::ProfileDescription& profile);

/// Throws InputError at the first of the channels, `written` so in the document, that lies within the terms in part, and at the
/// gas model where none is within. `terms` may be null.
void check_gas_model(const io::DocumentSources& sources, const io::ModelledAtmosphere& air,
                     std::span<const io::ChannelDocument> written,
                     std::span<const radiometry::Channel> channels, const atmosphere::GasTermTable* terms);

/// Gases, range and bins in words, and how many of the channels are within; after that the source, if there is one.
std::vector<std::string> gas_model_statements(const atmosphere::GasTermTable& terms,
                                              std::span<const radiometry::Channel> channels);

/// The terms where all of the channels are within them; null else.
const atmosphere::GasTermTable* terms_of_all(const atmosphere::GasTermTable* terms,
                                             std::span<const radiometry::Channel> channels);

}  // namespace ifov::session
