#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/city/city_json_reader.h"
#include "mesh_measures.h"
#include "scratch_mesh.h"
#include "support/truth_data.h"

namespace ifov::io::test_city_json {
namespace {

using math::Point3;

/// A box of 10 x 10 x 5 m whose roof has a hole of 2 x 2 m, given as one building with a part, and a road.
std::string city(const std::string& objects, const std::string& more = "") {
  return R"({"type": "CityJSON", "version": "2.0",
"metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"},
"transform": {"scale": [0.001, 0.001, 0.001], "translate": [84616.468, 447422.999, -0.452]},
"vertices": [[0,0,0], [10000,0,0], [10000,10000,0], [0,10000,0], [0,0,5000], [10000,0,5000], [10000,10000,5000],
[0,10000,5000], [4000,4000,5000], [6000,4000,5000], [6000,6000,5000], [4000,6000,5000]],)" +
         more + "\"CityObjects\": {" + objects + "}}";
}

const std::string kShell =
    "[[[[0,3,2,1]], [[4,5,6,7], [8,9,10,11]], [[0,1,5,4]], [[1,2,6,5]], [[2,3,7,6]], [[3,0,4,7]]]]";
const std::string kSolid = R"({"type": "Solid", "lod": "2.2", "boundaries": )" + kShell + "}";

CityModel parsed(const std::string& text, const CityJsonChoice& choice = {}) {
  const test::ScratchMesh file("a.city.json", text);
  return read_city_json(file.path(), choice);
}

std::string message_of(const std::string& text, const CityJsonChoice& choice = {}) {
  try {
    parsed(text, choice);
  } catch (const InputError& e) {
    const std::string all = e.what();
    const std::string first = all.substr(0, all.find('\n'));
    return first.substr(first.find(".json") + 5);
  }
  return "no error";
}

double area_of(const CityObject& object, const std::string& slot) {
  double area = 0.0;
  const geometry::TriangleMesh& mesh = object.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.slot_names[mesh.slots[t]] != slot) continue;
    const Point3 a = mesh.vertices_m[mesh.triangles[t][0]];
    area += 0.5 * length(cross(mesh.vertices_m[mesh.triangles[t][1]] - a,
                               mesh.vertices_m[mesh.triangles[t][2]] - a));
  }
  return area;
}

TEST(CityJson, ReadsASolidWithAHoleInItsRoof) {
  const CityModel model = parsed(city(R"("a": {"type": "Building", "geometry": [)" + kSolid + "]}"));
  ASSERT_EQ(model.objects.size(), 1u);
  const CityObject& building = model.objects[0];
  EXPECT_EQ(model.version, "2.0");
  EXPECT_EQ(model.reference_system, "https://www.opengis.net/def/crs/EPSG/0/7415");
  EXPECT_EQ(model.surfaces, 6u);
  EXPECT_EQ(model.repaired_surfaces, 0u);
  EXPECT_EQ(building.lod, "2.2");
  // Without semantics the surfaces are told apart by where they face.
  EXPECT_NEAR(area_of(building, "RoofSurface"), 96.0, 1e-9);
  EXPECT_NEAR(area_of(building, "GroundSurface"), 100.0, 1e-9);
  EXPECT_NEAR(area_of(building, "WallSurface"), 200.0, 1e-9);
  EXPECT_NEAR(model.low.x, 84616.468, 1e-9);
  EXPECT_NEAR(model.high.y, 447432.999, 1e-9);
  EXPECT_NEAR(model.high.z, 4.548, 1e-12);
  // The roof's triangles all face up.
  double up = 0.0;
  const geometry::TriangleMesh& mesh = building.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.slot_names[mesh.slots[t]] == "RoofSurface") {
      const Point3 a = mesh.vertices_m[mesh.triangles[t][0]];
      up += cross(mesh.vertices_m[mesh.triangles[t][1]] - a, mesh.vertices_m[mesh.triangles[t][2]] - a).z;
    }
  EXPECT_NEAR(up, 2.0 * 96.0, 1e-9);
}

TEST(CityJson, SemanticsBecomeSlotsAndPartsJoinTheirBuilding) {
  const std::string semantics =
      R"(, "semantics": {"surfaces": [{"type": "WallSurface"}, {"type": "+Glass"}], "values": [[0, 1, null, 0, 0, 0]]}})";
  std::string solid = kSolid;
  solid.pop_back();
  const CityModel model = parsed(city(
      R"("a": {"type": "Building", "children": ["b", "c"], "attributes": {"use": "church", "year": 1900, "old": true, "x": null}},
"b": {"type": "BuildingPart", "parents": ["a"], "geometry": [)" +
      solid + semantics + R"(]},
"c": {"type": "BuildingPart", "parents": ["a"], "geometry": [{"type": "MultiSurface", "lod": 1, "boundaries": [[[0,1,2]]]}]},
"r": {"type": "Road", "geometry": [{"type": "CompositeSurface", "lod": "1", "boundaries": [[[0,1,2]]]}]},
"p": {"type": "Road", "geometry": [{"type": "MultiPoint", "lod": "1", "boundaries": [0]}]})"));
  ASSERT_EQ(model.objects.size(), 2u);
  const CityObject& building = model.objects[0];
  EXPECT_EQ(building.id, "a");
  EXPECT_EQ(building.type, "Building");
  EXPECT_EQ(building.lod, "2.2");
  EXPECT_EQ(building.attributes, (std::vector<std::pair<std::string, std::string>>{
                                     {"use", "church"}, {"year", "1900"}, {"old", "true"}}));
  EXPECT_EQ(building.mesh.slot_names, (std::vector<std::string>{"WallSurface", "+Glass", "RoofSurface"}));
  EXPECT_EQ(model.objects[1].mesh.slot_names, std::vector<std::string>{"Road"});
  EXPECT_EQ(model.lines_and_points, 1u);
}

TEST(CityJson, TakesTheFinestOrTheStatedLevelOfDetail) {
  const std::string objects = R"("a": {"type": "Building", "geometry": [
{"type": "MultiSurface", "lod": "1.2", "boundaries": [[[0,1,2]]]}, )" +
                              kSolid + R"(]},
"b": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": 1.2, "boundaries": [[[0,1,2]]]}]})";
  const CityModel finest = parsed(city(objects));
  EXPECT_EQ(finest.objects[0].lod, "2.2");
  EXPECT_EQ(finest.objects[1].lod, "1.2");
  const CityModel coarse = parsed(city(objects), {"1.2", {}});
  EXPECT_EQ(coarse.objects[0].mesh.triangles.size(), 1u);
  EXPECT_EQ(parsed(city(objects), {"2.2", {}}).objects_without_lod, 1u);
  EXPECT_EQ(message_of(city(objects), {"3", {}}),
            ": no object has the level of detail 3; the file has '1.2' and '2.2'");
  EXPECT_EQ(parsed(city(objects), {"", {"Building"}}).objects.size(), 2u);
  EXPECT_EQ(message_of(city(objects), {"", {"Road"}}),
            ": no object is of a type asked for; the file has 'Building'");
}

TEST(CityJson, CopiesTemplates) {
  const CityModel model = parsed(city(
      R"("t": {"type": "SolitaryVegetationObject", "geometry": [{"type": "GeometryInstance", "template": 0,
"boundaries": [1], "transformationMatrix": [0,-2,0,1, 2,0,0,0, 0,0,2,0, 0,0,0,1]}]})",
      R"("geometry-templates": {"templates": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0,1,2]]]}],
"vertices-templates": [[0,0,0], [1,0,0], [0,1,0]]},)"));
  ASSERT_EQ(model.objects.size(), 1u);
  const CityObject& tree = model.objects[0];
  EXPECT_EQ(tree.lod, "2");
  ASSERT_EQ(tree.mesh.vertices_m.size(), 3u);
  EXPECT_NEAR(tree.origin.x, 84616.468 + 10.0 + 1.0, 1e-9);
  EXPECT_NEAR(tree.mesh.vertices_m[1].y, 2.0, 1e-9);
  EXPECT_NEAR(tree.mesh.vertices_m[2].x, -2.0, 1e-9);
}

TEST(CityJson, RepairsRingsThatCross) {
  // A bow tie of two triangles of 25 m2 each, and a hole that leaves its polygon.
  const CityModel bow = parsed(city(
      R"("a": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": "1", "boundaries": [[[0,1,3,2,8,9,10,11]]]}]},
"b": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": "1", "boundaries": [[[4,5,6,4]], [[4,5,4,5]]]}]})"));
  EXPECT_EQ(bow.objects.size(), 2u);
  EXPECT_EQ(bow.empty_surfaces, 1u);
  const CityModel hole = parsed(city(
      R"("a": {"type": "Road", "geometry": [{"type": "MultiSurface", "lod": "1", "boundaries": [[[8,9,10,11], [4,5,10]]]}]})"));
  EXPECT_EQ(hole.repaired_surfaces, 1u);
}

TEST(CityJson, RulesPickTheMostParticularName) {
  CityObject church;
  church.type = "Building";
  church.attributes = {{"use", "church"}, {"year", "1900"}};
  const auto name = [&](const std::vector<std::string>& names) {
    const std::string* found = city_slot(church, "RoofSurface", names);
    return found == nullptr ? std::string("none") : *found;
  };
  EXPECT_EQ(name({"other", "Building", "RoofSurface", "Building/RoofSurface", "Building[use=church]",
                  "Building[year=1900]/RoofSurface"}),
            "Building[year=1900]/RoofSurface");
  EXPECT_EQ(name({"other", "Building", "RoofSurface", "Building/RoofSurface", "Building[use=church]"}),
            "Building[use=church]");
  EXPECT_EQ(name({"other", "Building", "RoofSurface", "Building/RoofSurface", "Building[use=barn]"}),
            "Building/RoofSurface");
  EXPECT_EQ(name({"other", "Building", "RoofSurface"}), "RoofSurface");
  EXPECT_EQ(name({"other", "Building"}), "Building");
  EXPECT_EQ(name({"other", "WallSurface"}), "other");
  EXPECT_EQ(name({"WallSurface"}), "none");
}

TEST(CityJson, ErrorsShowThePlace) {
  const auto road = [](const std::string& geometry) {
    return city("\n\"a\": {\"type\": \"Road\", \"geometry\": [" + geometry + "]}");
  };
  EXPECT_EQ(message_of("{\"type\": \"GeoJSON\"}"),
            ":1:10: 'type' is the text \"GeoJSON\", expected \"CityJSON\"");
  EXPECT_EQ(message_of("{\"type\": \"CityJSON\", \"version\": \"0.9\"}"),
            ":1:33: 'version' is the text \"0.9\", expected \"1.0\", \"1.1\" or \"2.0\"");
  EXPECT_EQ(message_of("[1, 2"),
            ":1:6: the file ends here, within the list that begins at 1:1; still to close: ]");
  EXPECT_EQ(message_of(road(R"({"type": "MultiSurface", "lod": "1", "boundaries": [[[0,1,12]]]})")),
            ":6:94: 'CityObjects.a.geometry[0].boundaries[0][0][2]' is the number 12, expected a vertex from "
            "0 to 11");
  EXPECT_EQ(message_of(road(R"({"lod": "1"})")), ":6:36: 'CityObjects.a.geometry[0]' has no 'type'");
  EXPECT_EQ(
      message_of(road(R"({"type": "MultiSurface", "lod": "1", "boundaries": [[0,1,2]]})")),
      ":6:89: 'CityObjects.a.geometry[0].boundaries[0][0]' is the number 0, expected a list of vertices");
  EXPECT_EQ(
      message_of(city("\"a\": {\"type\": \"Road\", \"parents\": [\"a\"], \"geometry\": [" + kSolid + "]}")),
      ":5:105: the parents of this object run in a circle");
  EXPECT_EQ(message_of(city("\"a\": {\"type\": \"Road\"}")), ": the file has no surfaces");
  EXPECT_THROW(read_city_json("/no/such/file.json"), SystemError);
}

TEST(CityJson, AFileCutShortSaysWhatWasOpen) {
  const std::string whole = city("\"a\": {\"type\": \"Building\", \"geometry\": [" + kSolid + "]}");
  ASSERT_EQ(message_of(whole), "no error");
  const auto cut_behind = [&](const std::string& last) {
    return message_of(whole.substr(0, whole.find(last) + last.size()));
  };
  EXPECT_EQ(cut_behind("[4000,4000,5000],"),
            ":5:34: the file ends here, within the list 'vertices' that begins at 4:13; still to close: ]}");
  EXPECT_EQ(cut_behind("[8,9,1"),
            ":5:223: the file ends here, within the list 'CityObjects.a.geometry[0].boundaries[0][1][1]' "
            "that begins "
            "at 5:217; still to close: ]]]]}]}}}");
  EXPECT_EQ(cut_behind("Building"),
            ":5:128: the file ends here, within a text that begins at 5:119 in the object 'CityObjects.a' "
            "that begins "
            "at 5:110; still to close: \"}}}");
  for (std::size_t length = 1; length < whole.size(); ++length)
    ASSERT_NE(message_of(whole.substr(0, length)).find("the file ends here, within"), std::string::npos)
        << length;
}

/// Counts of the reference files by a look at their JSON; tests/io/test_city_models.py has an independent
/// reader.
TEST(CityJson, ReadsTheReferenceFiles) {
  const auto folder = test::truth_file("scenes/buildings-cityjson");
  if (!folder) GTEST_SKIP() << "reference data not found: scenes/buildings-cityjson";
  const CityModel delft = read_city_json(*folder / "delft.json");
  EXPECT_EQ(delft.objects.size(), 570u);
  EXPECT_EQ(delft.surfaces, 36271u);
  EXPECT_NEAR(delft.low.x, 84616.468, 5e-4);
  EXPECT_NEAR(delft.low.y, 447422.999, 5e-4);
  const CityModel zurich = read_city_json(*folder / "zurich_subset_lod2.json");
  EXPECT_EQ(zurich.objects.size(), 49u);
  EXPECT_EQ(zurich.surfaces, 2039u);
  EXPECT_EQ(read_city_json(*folder / "multi_lod.json").objects[0].lod, "2.2");
  EXPECT_EQ(read_city_json(*folder / "rotterdam_subset.json").objects.size(), 16u);
  EXPECT_EQ(read_city_json(*folder / "DH_01_subs.city.json").objects.size(), 4u);
  const CityModel cube = read_city_json(*folder / "cube.json");
  EXPECT_NEAR(test::measures_of(cube.objects[0].mesh).area, 6.0, 1e-9);
  EXPECT_NEAR(test::measures_of(cube.objects[0].mesh).volume, 1.0, 1e-9);
}

}  // namespace
}  // namespace ifov::io::test_city_json
