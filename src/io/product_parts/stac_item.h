#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/product_parts/raster_view.h"
#include "io/product_parts/run_record.h"

namespace ifov::io {

/// What a catalogue's reader is told of a file that a run has left.
struct StacAsset {
  std::string key, media_type;
  std::vector<std::string> roles;
  bool has_channels = false;  ///< its bands are the channels
};

/// Of `<stem>_radiance.img` and so on; `file` and `stem` are names of files without folders.
StacAsset stac_asset(const std::string& file, const std::string& stem);

/// Degrees, east and north.
struct StacPlace {
  double longitude_deg = 0.0, latitude_deg = 0.0;
};
using StacRing = std::vector<StacPlace>;  ///< not closed

/// Rings of what an outline encloses, each counter-clockwise and without crossings (an outline that crosses itself is replaced by its hull), two where it reaches
/// over the date line. None where there are fewer than three places.
std::vector<StacRing> stac_polygons(StacRing outline);

/// An Item of the SpatioTemporal Asset Catalog, 1.0.0. `location` may be empty; `files` are of `record` and beside `path`.
std::string stac_item(const RunRecord& record, const WideView& location, const std::filesystem::path& path,
                      const std::string& stem);

}  // namespace ifov::io
