#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/mesh/gltf_reader.h"
#include "mesh_measures.h"
#include "scratch_mesh.h"
#include "support/truth_data.h"

namespace ifov::io::test_mesh_gltf {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using math::Point3;

/// One triangle (0,0,0), (1,0,0), (0,1,0) with 16-bit indices, texture coordinates and a normal: 36 + 24 + 36
/// + 6.
std::string triangle_bytes() {
  const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.25f, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  const std::uint16_t indices[] = {0, 1, 2};
  std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
  return bytes.append(reinterpret_cast<const char*>(indices), sizeof indices);
}

const std::string kNodes = R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}])";

/// The text of a file around that triangle; `nodes` holds scenes and nodes.
std::string gltf(const std::string& nodes = kNodes, const std::string& uri = R"("uri": "a b.bin", )") {
  return R"({"asset": {"version": "2.0"}, )" + nodes +
         R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "NORMAL": 2}, "indices": 3,
    "material": 0}]}],
  "materials": [{"name": "tile"}],
  "buffers": [{)" +
         uri + R"("byteLength": 102}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
    {"buffer": 0, "byteOffset": 60, "byteLength": 36}, {"buffer": 0, "byteOffset": 96, "byteLength": 6}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
    {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 3, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TriangleMesh parsed(const std::string& text) {
  const test::ScratchMesh file("a.gltf", text);
  file.add("a b.bin", triangle_bytes());
  return read_gltf(file.path());
}

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const InputError& e) {
    const std::string all = e.what();
    return all.substr(all.find(".gltf") + 5);
  }
  return "no error";
}

std::string glb(std::string json, const std::string& binary) {
  while (json.size() % 4 != 0) json += ' ';
  std::string bytes = "glTF";
  const auto put = [&](std::size_t number) {
    const auto word = static_cast<std::uint32_t>(number);
    bytes.append(reinterpret_cast<const char*>(&word), 4);
  };
  std::string padded = binary;
  while (padded.size() % 4 != 0) padded += '\0';
  put(2), put(12 + 8 + json.size() + 8 + padded.size());
  put(json.size()), put(0x4e4f534a);
  bytes += json;
  put(padded.size()), put(0x004e4942);
  return bytes + padded;
}

TEST(MeshGltf, ReadsATriangleWithItsAttributes) {
  const TriangleMesh mesh = parsed(gltf(kNodes, R"("uri": "a%20b.bin", )"));
  EXPECT_EQ(mesh.vertices_m, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh.slot_names, std::vector<std::string>{"tile"});
  EXPECT_EQ(mesh.uvs[0], (geometry::Uv{0.0, 1.0}));
  EXPECT_EQ(mesh.uvs[1], (geometry::Uv{1.0, 1.0}));
  EXPECT_EQ(mesh.uvs[2], (geometry::Uv{0.0, 0.75}));
  EXPECT_EQ(mesh.normals[0], (math::Normal3{0, 0, 1}));
}

TEST(MeshGltf, ReadsTheBinaryFormAndInlineBuffers) {
  const test::ScratchMesh file("a.glb", glb(gltf(kNodes, ""), triangle_bytes()));
  EXPECT_EQ(read_gltf(file.path()).vertices_m[1], (Point3{1, 0, 0}));
  EXPECT_EQ(
      message_of(replaced(gltf(), "a b.bin", "data:application/octet-stream;base64,AAAA")).substr(0, 27),
      ": not a valid glTF 2 file: ");
}

TEST(MeshGltf, AppliesTheTransformsOfAllNodes) {
  const TriangleMesh mesh = parsed(gltf(
      R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [1, 2], "translation": [100000.25, 0, 0]},
      {"mesh": 0, "scale": [2, 3, 4], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]},
      {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]}])"));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(mesh.vertices_m[1].x, 100000.25, 1e-9);
  EXPECT_NEAR(mesh.vertices_m[1].y, 2.0, 1e-12);
  EXPECT_NEAR(mesh.vertices_m[2].x, 100000.25 - 3.0, 1e-9);
  EXPECT_EQ(mesh.vertices_m[4], (Point3{99999.25, 0, 5}));
  // The mirrored copy still faces +z.
  const Triangle t = mesh.triangles[1];
  const auto n =
      cross(mesh.vertices_m[t[1]] - mesh.vertices_m[t[0]], mesh.vertices_m[t[2]] - mesh.vertices_m[t[0]]);
  EXPECT_GT(n.z, 0.0);
  EXPECT_EQ(mesh.normals[3], (math::Normal3{0, 0, 1}));
}

TEST(MeshGltf, ReadsStripsAndFans) {
  const std::string strip = replaced(gltf(), R"("indices": 3,)", R"("mode": 5,)");
  EXPECT_EQ(parsed(strip).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(parsed(replaced(strip, R"("mode": 5)", R"("mode": 6)")).triangles.size(), 1u);
  EXPECT_EQ(message_of(replaced(strip, R"("mode": 5)", R"("mode": 1)")), ": the scene has no triangles");
}

TEST(MeshGltf, ErrorsSayWhatIsWrong) {
  EXPECT_EQ(message_of("{\n  \"asset\": [}\n").substr(0, 6), ":2:13:");
  EXPECT_EQ(message_of(gltf(kNodes, R"("uri": "../a.bin", )")).substr(0, 3), ":4:");
  EXPECT_NE(message_of(gltf(kNodes, R"("uri": "../a.bin", )"))
                .find("the buffer '../a.bin' does not lie in the folder"),
            std::string::npos);
  EXPECT_NE(message_of(gltf(kNodes, R"("uri": "/etc/passwd", )")).find("does not lie in the folder"),
            std::string::npos);
  EXPECT_NE(message_of(gltf(kNodes, R"("uri": "gone.bin", )")).find("there is no file"), std::string::npos);
  EXPECT_EQ(message_of(replaced(gltf(), R"("count": 3, "type": "VEC3"})", R"("count": 4, "type": "VEC3"})")),
            ": accessor 0 (POSITION): its 4 elements reach beyond the 36 bytes of its buffer view");
  EXPECT_EQ(message_of(replaced(gltf(), R"("count": 3, "type": "VEC2")", R"("count": 2, "type": "VEC2")")),
            ": accessor 1 (TEXCOORD_0) has 2 entries for 3 vertices");
  EXPECT_EQ(message_of(replaced(gltf(), R"("byteOffset": 96, "byteLength": 6)",
                                R"("byteOffset": 46, "byteLength": 6)")),
            ": accessor 3 (indices): entry 0 names vertex 16256 of 3");
  EXPECT_EQ(message_of(replaced(gltf(), R"("byteOffset": 0, "byteLength": 36)",
                                R"("byteOffset": 90, "byteLength": 36)")),
            ": accessor 0 (POSITION): its buffer view reaches beyond the 102 bytes of buffer 0");
  EXPECT_EQ(message_of(gltf(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [0]}])")),
            ": node 0 has more than one parent");
  EXPECT_EQ(message_of(gltf(R"("scenes": [{"nodes": [7]}], "nodes": [{"mesh": 0}])")),
            ": there is no node 7: the file has 1");
  EXPECT_EQ(message_of(gltf(R"("extensionsRequired": ["KHR_draco_mesh_compression"], )" + kNodes)),
            ": it needs the extension 'KHR_draco_mesh_compression', which is not read");
  EXPECT_EQ(message_of(replaced(gltf(), R"("version": "2.0")", R"("version": "1.0")")),
            ": expected glTF version 2, found '1.0'");
}

/// Every position of a small file damaged: an error or a mesh whose indices are good.
TEST(MeshGltf, DamagedFilesAreHandled) {
  const std::string good = glb(gltf(kNodes, ""), triangle_bytes());
  int errors = 0;
  for (std::size_t at = 0; at < good.size(); at += 9)
    for (const char c : {'9', '\0', '\xff', '"'}) {
      std::string bytes = good;
      bytes[at] = c;
      const test::ScratchMesh file("a.glb", bytes);
      try {
        const TriangleMesh mesh = read_gltf(file.path());
        for (const Triangle& t : mesh.triangles)
          for (const std::uint32_t i : t) ASSERT_LT(i, mesh.vertices_m.size());
      } catch (const InputError&) {
        ++errors;
      }
    }
  EXPECT_GT(errors, 150);
}

/// Bounds and areas of the reference files; the boxes are unit cubes.
TEST(MeshGltf, ReadsTheReferenceFiles) {
  const auto folder = test::truth_file("scenes/gltf");
  if (!folder) GTEST_SKIP() << "reference data not found: scenes/gltf";
  for (const char* name :
       {"BoxTextured.glb", "BoxTextured-glTF/BoxTextured.gltf", "BoxTexcoords-glTF/boxTexcoords.gltf"}) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = read_gltf(*folder / name);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_GE(mesh.uvs.size(), 24u);
    const test::MeshMeasures m = test::measures_of(mesh);
    const double side = m.high.x - m.low.x;
    EXPECT_NEAR(m.area, 6.0 * side * side, 1e-5 * m.area);
    EXPECT_NEAR(m.volume, side * side * side, 1e-5 * m.volume);
  }
  const TriangleMesh square = read_gltf(*folder / "cameras/Cameras.gltf");
  EXPECT_EQ(square.triangles.size(), 2u);
  EXPECT_NEAR(test::measures_of(square).area, 1.0, 1e-6);
  EXPECT_GE(read_gltf(*folder / "textureTransform/TextureTransformTest.gltf").triangles.size(), 18u);
}

}  // namespace
}  // namespace ifov::io::test_mesh_gltf
