#pragma once

#include <filesystem>
#include <vector>

#include "session/session.h"

namespace ifov::io {
struct Document;
}

namespace ifov::session {

struct SeriesRecord;

/// What a series has beside the products of its times.
struct SeriesFiles {
  std::vector<ProductFile> files;
};

/// Makes them from the products of all times: an animation of a thermal channel, and how warm each material was, with the
/// crossovers, as table and figure. Where there is no such channel, or nothing is told of materials, the log (may be null) hears
/// what is left out. Errors as of io::EnviReader.
SeriesFiles make_series_products(const std::filesystem::path& folder, const SeriesRecord& series,
                                 const io::Document& document, LogSink* log);

}  // namespace ifov::session
