#include "session/assembly/atmosphere/gas_model_assembly.h"

#include <algorithm>
#include <filesystem>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/gas/column_terms.h"
#include "atmosphere/sensor/channel_bins.h"
#include "core/format.h"
#include "io/atmosphere/gas_model_file.h"
#include "io/document/atmosphere_document.h"
#include "io/document/sensor_document.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {
namespace {

using atmosphere::Covered;
using atmosphere::GasTermTable;

std::string range_of(const GasTermTable& terms) {
  return format("{:.5g} to {:.5g} um ({:g} to {:g} cm-1)", 1e4 / terms.last_cm1(), 1e4 / terms.first_cm1,
                terms.first_cm1, terms.last_cm1());
}

}  // namespace

std::shared_ptr<const GasTermTable> assemble_gas_model(const io::DocumentSources& sources,
                                                       const io::ModelledAtmosphere& air,
                                                       const atmosphere::ProfileDescription& profile) {
  if (!air.gas_model) return nullptr;
  return with_position(sources, air.gas_model->position, [&] {
    const auto terms = std::make_shared<const GasTermTable>(io::read_gas_model(air.gas_model->path));
    const atmosphere::Profile built = atmosphere::build_profile(profile).profile;
    // Whether it is for this air is told where the document names it.
    const atmosphere::ColumnTerms checked(terms, built, atmosphere::level_altitudes_km(built.ground_km()));
    return terms;
  });
}

void check_gas_model(const io::DocumentSources& sources, const io::ModelledAtmosphere& air,
                     std::span<const io::ChannelDocument> written,
                     std::span<const radiometry::Channel> channels, const GasTermTable* terms) {
  if (terms == nullptr) return;
  bool any = false;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const radiometry::Channel& channel = channels[c];
    const Covered how = atmosphere::covered(channel, terms);
    any = any || how == Covered::all;
    if (how == Covered::part)
      throw io::document_error(
          sources, written[c].position,
          format(
              "the channel '{}' reaches from {:.5g} to {:.5g} um, and the gas model from {}: expected a channel to lie "
              "within it, or outside, where the built-in bands hold",
              channel.name, channel.response.first_um(), channel.response.last_um(), range_of(*terms)));
  }
  if (!any)
    throw io::document_error(
        sources, air.gas_model->position,
        format("no channel lies within the gas model, which reaches from {}", range_of(*terms)));
}

std::vector<std::string> gas_model_statements(const GasTermTable& terms,
                                              std::span<const radiometry::Channel> channels) {
  std::size_t within = 0;
  for (const radiometry::Channel& channel : channels)
    within += atmosphere::covered(channel, &terms) == Covered::all ? 1 : 0;
  const std::string others = within == channels.size()
                                 ? "all channels are within"
                                 : format("{} of {} channels are within, the others have the built-in bands",
                                          within, channels.size());
  std::vector<std::string> lines;
  lines.push_back(format("Gas model: {} from {}, {}, in bins of {:g} cm-1; {}.",
                         std::filesystem::path(terms.name).filename().string(), range_of(terms),
                         io::gases_of(terms), terms.step_cm1, others));
  if (!terms.source.empty()) lines.push_back(format("Its source: {}.", terms.source));
  return lines;
}

const GasTermTable* terms_of_all(const GasTermTable* terms, std::span<const radiometry::Channel> channels) {
  const auto within = [&](const radiometry::Channel& channel) {
    return atmosphere::covered(channel, terms) == Covered::all;
  };
  return std::all_of(channels.begin(), channels.end(), within) ? terms : nullptr;
}

}  // namespace ifov::session
