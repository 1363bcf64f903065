#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace ifov::io {

/// One object of a city model with its parts: a building, a road, a tree.
struct CityObject {
  std::string id;
  std::string type;  ///< "Building", "Road", ...; of the object that the parts belong to
  /// Single values, as text, in the file's order.
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string lod;  ///< of the geometry taken, the finest of its parts

  /// Vertices are metres about `origin`, slots the kinds of surfaces (see read_city_json).
  geometry::TriangleMesh mesh;
  math::Point3 origin;  ///< easting, northing and height in the file's reference system
};

struct CityModel {
  std::string version;           ///< of CityJSON
  std::string reference_system;  ///< as the file names it; may be empty
  std::vector<CityObject> objects;
  math::Point3 low, high;  ///< bounds of all vertices that triangles use

  std::size_t surfaces = 0;
  std::size_t repaired_surfaces = 0;  ///< rings that crossed
  std::size_t empty_surfaces = 0;     ///< without area, left out
  std::size_t lines_and_points = 0;   ///< geometries without surfaces, left out
  std::size_t objects_without_lod = 0;
};

/// Names by which a document may state the material of the surfaces `slot` of `object`, the most particular
/// one first; entries of `slots` of the document are tried in this order:
///   Building[function=church]/RoofSurface, Building[function=church], Building/RoofSurface, RoofSurface,
///   Building, other
/// with every attribute of the object. `names` are the entries given; null where none of them suits.
const std::string* city_slot(const CityObject& object, std::string_view slot,
                             const std::vector<std::string>& names);

}  // namespace ifov::io
