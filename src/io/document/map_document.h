#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/document/document_values.h"

namespace ifov::io {

/// What lies beyond the edges of a map: its last cells, or the map again, or the map reversed and then again.
enum class Tiling { edge, repeat, mirror };

struct RasterPlacement {
  double x_m = 0.0, y_m = 0.0;           ///< lower left corner
  double width_m = 0.0, height_m = 0.0;  ///< towards +x and +y
};

/// A raster that lies on surfaces: draped from above, where without a placement its own georeference counts, or by texture coordinates.
struct RasterDocument {
  using Placement = RasterPlacement;
  DocumentFile file;
  std::optional<Placement> placement;
  bool by_texture = false;
  std::array<double, 2> copies{1.0, 1.0};  ///< by texture coordinates: rasters in one unit of u and of v
  Tiling tiling = Tiling::edge;
};

struct TemperatureMap {
  RasterDocument raster;
  double offset_k = 0.0;  ///< kelvin = number in the raster + offset_k
};

/// Of a material with `thermal`, under the document's weather.
struct SolvedTemperatureDocument {};

struct TemperatureDocument {
  std::variant<double, TemperatureMap, SolvedTemperatureDocument> value;  ///< kelvin, a map, or solved
  SourcePosition position;
};

/// An image of a material in a spectral range.
struct TextureImage {
  RasterDocument raster;
  int band = 1;  ///< from 1
  double from_um = 0.0, to_um = 0.0;
};

/// Which of a material's curves stands where.
struct TextureDocument {
  std::vector<TextureImage> images;
  bool covariance = false;  ///< match by Mahalanobis's distance
  SourcePosition position;
};

/// Relief finer than the geometry: it tilts the surface and moves nothing.
struct HeightRelief {
  RasterDocument raster;
  double unit_m = 1.0;  ///< metres per unit of the numbers
};
struct NormalRelief {
  RasterDocument raster;
  double factor = 1.0, offset = 0.0;  ///< component = factor x number + offset
};
struct ReliefDocument {
  std::variant<HeightRelief, NormalRelief> value;
  SourcePosition position;
};

/// Which material a class of a raster means.
struct MaterialMap {
  RasterDocument raster;
  std::vector<std::pair<std::int64_t, DocumentName>> classes;  ///< rising class numbers
};

/// Shares of materials, one band for each.
struct MixtureDocument {
  RasterDocument raster;
  std::vector<DocumentName> materials;  ///< in the order of the bands
};

/// Materials by the names a mesh file uses (`usemtl`).
struct MaterialSlots {
  std::vector<std::pair<std::string, DocumentName>> slots;
};

struct FileMaterials;
struct MaterialBinding {
  std::variant<DocumentName, MaterialMap, MaterialSlots, MixtureDocument,
               std::shared_ptr<const FileMaterials>>
      value;
  SourcePosition position;
};

/// A digital elevation model.
struct TerrainShape {
  DocumentFile file;
  std::optional<RasterDocument::Placement> placement;
  int band = 1;  ///< from 1
  double detail_m = 0.0;
  std::optional<double> unit_m;  ///< metres per unit of the heights; none: as the file says
  bool fill = false;             ///< cells without a height are filled; else they are holes
  bool smooth = true;
  enum class Form { mesh, grid };  ///< grid: traced in its raster, every height
  std::optional<Form> form;        ///< none: as suits the raster, see docs/formats/terrain.md
};

}  // namespace ifov::io
