#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/mesh/ply_reader.h"
#include "scratch_mesh.h"
#include "support/truth_data.h"

namespace ifov::io::test_mesh_ply {
namespace {

using geometry::Triangle;
using geometry::TriangleMesh;
using geometry::Uv;
using math::Point3;

TriangleMesh parsed(const std::string& bytes) { return read_ply(test::ScratchMesh("a.ply", bytes).path()); }

std::string message_of(const std::string& bytes) {
  try {
    parsed(bytes);
  } catch (const InputError& e) {
    EXPECT_FALSE(e.position().file.empty());
    const std::string all = e.what();
    return all.substr(all.find(".ply") + 4);
  }
  return "no error";
}

/// The bytes of numbers in either order.
template <class T>
void put(std::string& bytes, T value, bool big) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

const std::string kXyz = "element vertex 4\nproperty double x\nproperty float32 y\nproperty short z\n";
const std::string kSquare = "ply\nformat ascii 1.0\ncomment a square\nobj_info no\n" + kXyz +
                            "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST(MeshPly, CutsPolygonsAndSkipsWhatItDoesNotKnow) {
  const TriangleMesh mesh = parsed(
      "ply\nformat ascii 1.0\nelement camera 2\nproperty list int float knots\nproperty uchar k\n" + kXyz +
      "property list uchar float extra\nproperty float quality\nelement nothing 99999999999\n"
      "element face 2\nproperty uchar red\nproperty list uint8 uint8 vertex_index\nend_header\n"
      "3 1 2 3 7 0 8\n0 0 0 0 nan\n1 +0 0 2 5 5 1\n1 1e0 0 0 -inf\n.0 1 0 0 1\n9 4 0 1 2 3\n9\n3 2 1 0");
  EXPECT_EQ(mesh.vertices_m, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[2], (Triangle{2, 1, 0}));
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_TRUE(mesh.slots.empty());
}

TEST(MeshPly, ReadsBothByteOrders) {
  for (const bool big : {false, true}) {
    for (const std::string newline : {"\n", "\r\n"}) {
      std::string header = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" +
                           kXyz +
                           "property float s\nproperty float t\nelement face 1\nproperty list ushort int "
                           "vertex_indices\nend_header\n";
      for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += newline.size())
        header.replace(at, 1, newline);
      std::string bytes = header;
      const double x[4] = {85001.0625 + 1e-9, 85002.0, 85002.0, 85001.0};
      for (int k = 0; k < 4; ++k) {
        put(bytes, x[k], big);
        put(bytes, k / 2 == 0 ? -2.5f : 3.5f, big);
        put(bytes, static_cast<std::int16_t>(-7), big);
        put(bytes, 0.25f * static_cast<float>(k), big);
        put(bytes, 1.0f, big);
      }
      put(bytes, static_cast<std::uint16_t>(4), big);
      for (const std::int32_t i : {0, 1, 2, 3}) put(bytes, i, big);
      const TriangleMesh mesh = parsed(bytes);
      EXPECT_EQ(mesh.vertices_m[0], (Point3{85001.0625 + 1e-9, -2.5, -7.0}));
      EXPECT_EQ(mesh.triangles.size(), 2u);
      EXPECT_EQ(mesh.uvs[3], (Uv{0.75, 1.0}));
      EXPECT_TRUE(mesh.uv_corners.empty());
      EXPECT_EQ(message_of(bytes.substr(0, bytes.size() - 1)).substr(0, 6), ": byte");
    }
  }
}

TEST(MeshPly, KeepsTextureCoordinatesOfCorners) {
  const TriangleMesh mesh = parsed("ply\nformat ascii 1.0\n" + kXyz +
                                   "element face 2\nproperty list uchar float texcoord\nproperty list uchar "
                                   "int vertex_indices\nend_header\n"
                                   "0 0 0\n1 0 0\n1 1 0\n0 1 0\n6 0 0 1 0 1 1 3 0 1 2\n0 3 0 2 3\n");
  EXPECT_EQ(mesh.uvs, (std::vector<Uv>{{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(mesh.uv_corners[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.uv_corners[1][0], geometry::kNoIndex);
}

TEST(MeshPly, ReadsStrips) {
  const TriangleMesh mesh = parsed("ply\nformat ascii 1.0\n" + kXyz +
                                   "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                                   "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 3\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 1, 3}}));
}

TEST(MeshPly, ErrorsShowThePlace) {
  EXPECT_EQ(message_of("plx\n"), ":1:1: expected 'ply', the first line of a PLY file");
  EXPECT_EQ(message_of("ply\nformat binary 1.0\n"),
            ":2:8: expected ascii, binary_little_endian or binary_big_endian, found 'binary'");
  EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex many\n"),
            ":3:16: expected a count of rows, found 'many'");
  EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
            ":4:10: expected a type ('char', 'int8', 'uchar', 'uint8', 'short', 'int16', 'ushort', 'uint16', "
            "'int', "
            "'int32', 'uint', 'uint32', 'float', 'float32', 'double' or 'float64'), found 'real'");
  EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1"),
            ": the element 'vertex' has no property 'y'");
  EXPECT_EQ(
      message_of("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n1 2 3\n"),
      ": the header announces 4000000000 rows of 'vertex', which do not fit into the 6 bytes that follow it");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 one 0\n0 1 0\n4 0 1 2 3\n"),
            ":14:3: expected a number, found 'one'");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 1 inf\n0 1 0\n4 0 1 2 3\n"),
            ":14:5: expected a finite number for a coordinate, found inf");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 4\n"),
            ":16:9: there is no vertex number 4 (from 0): the file has 4");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n"),
            ":16:1: a face needs at least 3 corners, found 2");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n250 0 1 2\n"),
            ":16:1: a list announces 250 items, which do not fit into the 7 bytes left");
  EXPECT_EQ(message_of(kSquare + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1\n"),
            ":17:1: the file ends before all announced rows are read");
  EXPECT_THROW(read_ply("/no/such/file.ply"), SystemError);
}

TEST(MeshPly, ErrorsInBinaryFilesNameTheByte) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::size_t data = bytes.size();
  for (int k = 0; k < 9; ++k) put(bytes, static_cast<float>(k * k), false);
  put(bytes, static_cast<std::uint8_t>(3), false);
  for (const std::int32_t i : {0, 1, -2}) put(bytes, i, false);
  EXPECT_EQ(message_of(bytes), ": byte " + std::to_string(data + 45) +
                                   ": there is no vertex number -2 (from 0): the file has 3");
}

TEST(MeshPly, ReadsTextureCoordinatesOfAReferenceFile) {
  const auto file = test::truth_file("scenes/ply-variants/cube_uv.ply");
  if (!file) GTEST_SKIP() << "reference data not found: scenes/ply-variants/cube_uv.ply";
  const TriangleMesh mesh = read_ply(*file);
  ASSERT_EQ(mesh.uvs.size(), 24u);
  EXPECT_EQ(mesh.normals.size(), 24u);
  EXPECT_EQ(mesh.uvs[0], (Uv{0.0, 0.0}));
}

}  // namespace
}  // namespace ifov::io::test_mesh_ply
