#include "core/format.h"
#include "io/document/schema/record.h"
#include "io/document/tables/shape_tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostCopies = 1000000;
constexpr std::size_t kMostTypes = 100;

}  // namespace

SchemaType<MeshShape> mesh_type() {
  std::vector<std::pair<std::string, double>> units;
  for (const Unit& unit : kLength.units) units.emplace_back(unit.spelling, unit.factor);
  Record<MeshShape> record("mesh", "A triangle mesh from a file.");
  record
      .required("file", &MeshShape::file, file(),
                "the file, whose extension tells its format (docs/formats/meshes.md lists them)")
      .with_default("unit", &MeshShape::unit_m, choice<double>(units), "\"m\"", "unit of its coordinates")
      .optional(
          "up", &MeshShape::y_is_up, choice<bool>({{"z", false}, {"y", true}}),
          "which of its axes points up, if not y for glTF and z for the others; with y, its z points south");
  return record.type();
}

SchemaType<CityShape> city_type() {
  Record<CityShape> record("city",
                           "The objects of a city model, each of them placed and counted on its own.");
  record
      .required("file", &CityShape::file, file(),
                "a CityJSON file; its coordinates are those of the document")
      .optional(
          "lod", &CityShape::lod,
          text_like("^[0-9]([.][0-9])?$", "a level of detail such as \"2\" or \"2.2\"", "level of detail"),
          "the level of detail to place; the finest of each object if not given")
      .optional("types", &CityShape::types, list(label(), 1, kMostTypes),
                "types of the objects to place, such as \"Building\"; all if not given")
      .check([](const CityShape& city, const DocumentNode& node) {
        const std::string& lod = city.lod;
        const auto digit = [&](std::size_t k) { return lod[k] >= '0' && lod[k] <= '9'; };
        const bool good = lod.empty() || (lod.size() == 1 && digit(0)) ||
                          (lod.size() == 3 && digit(0) && lod[1] == '.' && digit(2));
        if (!good) node.given("lod").fail_expected("a level of detail such as \"2\" or \"2.2\"");
      });
  return record.type();
}

SchemaType<InstanceShape> instance_type() {
  Record<InstanceShape> record("instance", "One copy of a prototype.");
  record.required("of", &InstanceShape::of, name_of("a prototype"), "what is copied");
  return record.type();
}

SchemaType<InstancesShape> instances_type() {
  Record<InstancesShape> record("instances", "Many copies of a prototype.");
  record.required("of", &InstancesShape::of, name_of("a prototype"), "what is copied")
      .exactly_one()
      .one("at", &InstancesShape::at_m, list(point(), 1, kMostCopies), "where the prototype's origin goes")
      .one(
          "csv", &InstancesShape::csv, file(),
          "rows of x, y, z in metres, rotation about z in degrees (counter-clockwise from above), scale, pitch "
          "and roll in degrees; the last two or four may be left out")
      .one("binary", &InstancesShape::binary, file(), "a binary instance list (`.ifovinst`)");
  return record.type();
}

}  // namespace ifov::io
