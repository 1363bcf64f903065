#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/document/scene_document.h"
#include "io/raster/raster.h"
#include "materials/map_grid.h"
#include "session/assembly/shared/map_frame.h"

namespace ifov::session {

/// Where a raster of the document lies in the scene: its georeference or the place that the document gives, about the
/// scene's origin, or texture coordinates. Throws InputError where it has neither, is not north up or lies in another
/// projection than the scene.
materials::MapGrid grid_of(const io::RasterDocument& source, const io::Raster& raster, const MapFrame& frame);

/// Tells rasters apart by file and placing; `more` by what else is made of them.
std::string key_of(const io::RasterDocument& source, const std::string& more);

/// The rasters of a document, each read once.
class RasterStore {
 public:
  const io::Raster& read(const std::string& path);

 private:
  std::map<std::string, std::unique_ptr<const io::Raster>> rasters_;
};

/// One band of a raster. Throws InputError where there is no such band.
std::span<const float> band_of(const io::Raster& raster, int band, const std::string& path);

}  // namespace ifov::session
