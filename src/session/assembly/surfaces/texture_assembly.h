#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/run_control.h"
#include "io/document/scene_document.h"
#include "session/assembly/shared/map_frame.h"
#include "session/assembly/shared/map_scale.h"
#include "session/assembly/shared/raster_assembly.h"

namespace ifov::io {
struct DocumentSources;
}
namespace ifov::materials {
class OpacityMap;
class ReliefMap;
class TextureMap;
}  // namespace ifov::materials
namespace ifov::radiometry {
class Spectrum;
}

namespace ifov::session {

/// Makes the textures, reliefs and opacity maps of materials, each once, and knows every map of the scene. Keeps all references; `seed` tells
/// textures of the same numbers apart; `log` may be null.
class TextureAssembly {
 public:
  TextureAssembly(const io::DocumentSources& sources, const std::vector<io::MaterialDocument>& materials,
                  std::uint64_t seed, const MapFrame& frame, LogSink* log)
      : sources_(sources), written_(materials), seed_(seed), frame_(frame), log_(log) {}

  /// The texture of a material of the document, whose curves are given as reflectances. Says where a histogram looks
  /// clipped and where an image has cells without a number.
  std::shared_ptr<const materials::TextureMap> texture(std::size_t material,
                                                       const std::vector<radiometry::Spectrum>& curves);
  std::shared_ptr<const materials::ReliefMap> relief(std::size_t material);
  /// Null where it has no holes.
  std::shared_ptr<const materials::OpacityMap> holes(std::size_t material);

  const io::Raster& read(const io::RasterDocument& source) { return rasters_.read(source.file.path); }
  /// Where a raster lies; takes note of the size of its cells.
  materials::MapGrid grid(const io::RasterDocument& source, const io::Raster& raster);
  const std::vector<MapScale>& map_scales() const { return scales_; }

 private:
  struct Image;
  Image image(const io::TextureImage& source, const std::string& material);
  std::shared_ptr<const materials::ReliefMap> read_relief(const io::ReliefDocument& source);

  const io::DocumentSources& sources_;
  const std::vector<io::MaterialDocument>& written_;
  std::uint64_t seed_;
  const MapFrame& frame_;
  LogSink* log_;
  RasterStore rasters_;
  std::map<std::size_t, std::shared_ptr<const materials::TextureMap>> textures_;
  std::map<std::size_t, std::shared_ptr<const materials::ReliefMap>> reliefs_;
  std::map<std::size_t, std::shared_ptr<const materials::OpacityMap>> holes_;
  std::vector<MapScale> scales_;
};

}  // namespace ifov::session
