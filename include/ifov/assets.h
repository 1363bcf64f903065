#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ifov/api.h"

namespace ifov {

/// Triangles, counter-clockwise when seen from outside, as a mesh file holds them.
struct MeshAsset {
  std::vector<std::array<double, 3>> vertices;          ///< x, y, z; metres, or the document's "unit"
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of vertices, from 0
  std::vector<std::array<double, 3>> normals;           ///< of each vertex, of any length; empty: flat
  std::vector<std::array<double, 2>> uv;                ///< of each vertex; empty: none
  std::vector<std::uint32_t> materials;  ///< of each triangle, into material_names; empty: one material
  /// What the document's "material" gives materials for; empty: one without a name.
  std::vector<std::string> material_names;
};

/// Numbers on a grid, as a raster file holds them. Numbers of all types are kept as float: whole ones up to 2^24 exactly.
struct RasterAsset {
  int width = 0, height = 0, bands = 1;
  std::vector<float> values = {};  ///< [band][row][column], rows from the top
  /// Map coordinates of corners of cells: x = t[0] + column t[1] + row t[2], y = t[3] + column t[4] + row t[5]; none: the
  /// document says where it lies.
  std::optional<std::array<double, 6>> geotransform = {};
  std::string crs;                    ///< "EPSG:32633", a WKT or a PROJ string; empty: the scene's
  std::optional<double> nodata = {};  ///< what stands for no value
  std::vector<std::string> units;     ///< of each band, "m"; empty: nothing is said
};

/// Two columns of a table: values at wavelengths that ascend or descend.
struct SpectrumAsset {
  std::vector<double> wavelengths;  ///< micrometres, or the document's "wavelength_unit"
  std::vector<double> values;       ///< times the document's "scale"
};

/// Where copies stand, as a list of copies says it: each is scaled, then turned, then moved.
struct CopiesAsset {
  std::vector<std::array<double, 3>> positions_m;
  std::vector<double> yaw_rad;  ///< counter-clockwise from above; empty: not turned
  std::vector<double> scale;    ///< above 0; empty: as they are
};

/// What a file would hold, in any format that a document may name. Its name ends as that of the file would, "house.glb",
/// where the ending tells the format. A file that stands beside another is an asset beside it: "leaves.sli" and "leaves.hdr".
struct FileAsset {
  std::string bytes;
};

struct FacadeAccess;

/// What a program gives documents from memory, by name: "asset:roof" then stands for a file wherever a document may name one
/// but under "include", which is read with the document: for that of a mesh, a raster, a table of a spectrum or a list of
/// copies as arrays, for every file as its bytes. From there on nothing differs from a file, but
/// that the scene cache keeps nothing of it. Run states and records hold what the contents hash to: a run is not gone on with
/// under other ones.
class IFOV_API Assets {
 public:
  Assets();
  /// Each takes the place of what had the name. Throws InputError, with name and place in the arrays, on arrays that do not
  /// fit each other, indices beyond their lists and numbers that are not finite where they must be.
  void add(const std::string& name, const MeshAsset& mesh);
  void add(const std::string& name, const RasterAsset& raster);
  void add(const std::string& name, const SpectrumAsset& spectrum);
  void add(const std::string& name, const CopiesAsset& copies);
  void add(const std::string& name, FileAsset file);
  std::vector<std::string> names() const;  ///< sorted

 private:
  struct Inside;
  std::shared_ptr<Inside> inside_;
  friend struct FacadeAccess;
};

}  // namespace ifov
