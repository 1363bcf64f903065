#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geodesy/geodetic.h"
#include "session/session.h"

namespace ifov::session {

struct SeriesRecord;

/// A series all of whose times are made.
struct MadeSeries {
  const std::filesystem::path& folder;
  const SeriesRecord& record;
  std::vector<std::string> shown_channels;  ///< of the document's pictures; empty: none are named
  bool is_of_views = false;                 ///< no pictures but lists
  std::optional<geodesy::Geodetic> place;   ///< where the scene stands; none: it is not known
};

/// What a series has beside the products of its times.
struct SeriesFiles {
  std::vector<ProductFile> files;
};

/// Makes them from the products of all times: an animation of a thermal channel, and how warm each material was, with the
/// crossovers, as table and figure. Where there is no such channel, or nothing is told of materials, the log (may be null) hears
/// what is left out. Errors as of io::EnviReader.
SeriesFiles make_series_products(const MadeSeries& of, LogSink* log);

}  // namespace ifov::session
