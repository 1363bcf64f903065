#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/city/city_model.h"

namespace ifov::io {

struct CityJsonChoice {
  std::string lod;                 ///< "2.2"; empty: the finest that each object has
  std::vector<std::string> types;  ///< of the objects to take; empty: all
};

/// Reads a CityJSON file (cityjson.org, versions 1.0, 1.1 and 2.0): MultiSurface, CompositeSurface, Solid,
/// MultiSolid, CompositeSolid and GeometryInstance. The transform is applied in double. Polygons with holes
/// are cut into triangles; rings that cross are made valid and counted. Objects with parents (BuildingPart,
/// BuildingInstallation) join the object that they belong to in the end. The slots of a mesh are the semantic
/// surfaces of the file (RoofSurface, WallSurface, ...); surfaces of buildings without semantics are told
/// apart by their normals: RoofSurface within 60 degrees of upwards, GroundSurface within 30 degrees of
/// downwards, otherwise WallSurface; surfaces of other objects without semantics are in the slot of their
/// object's type. Appearance is not read. Throws InputError with file, line and column for anything broken,
/// SystemError if the file cannot be read.
CityModel read_city_json(const std::filesystem::path& path, const CityJsonChoice& choice = {});

}  // namespace ifov::io
