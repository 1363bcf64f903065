#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/mesh/obj_reader.h"
#include "support/truth_data.h"

namespace ifov::io::test_mesh_obj {
namespace {

using geometry::TriangleMesh;
using math::Point3;

TriangleMesh parsed(const std::string& text, LogSink* log = nullptr) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ifov_obj_" + std::to_string(::getpid()) + ".obj");
  std::ofstream(path, std::ios::binary) << text;
  struct Remove {
    std::filesystem::path path;
    ~Remove() { std::filesystem::remove(path); }
  } const remove{path};
  return read_obj(path, log);
}

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const InputError& e) {
    EXPECT_FALSE(e.position().file.empty());
    const std::string all = e.what();
    return all.substr(all.find(".obj") + 4);
  }
  return "no error";
}

TEST(MeshObj, ReadsFacesAttributesAndSlots) {
  const TriangleMesh mesh = parsed(
      "\xef\xbb\xbf# a comment\r\nv 0 0 0\r\nv 1 0 0 # another\r\nv 1 1 0 1.0\r\nv +0 1e0 0 .5 .5 .5\r\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0.5\nvn 0 0 1\n"
      "f 1 2 3\nusemtl two words\nf 1/1/1 2/2/1 \\\n  3/3/1 -1/-1/-1\nusemtl other\nf 1//1 3//1 4//1\nusemtl "
      "two words\nf 1/1 2/2 3/3");
  EXPECT_EQ(mesh.vertices_m.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 5u);
  EXPECT_EQ(mesh.slot_names, (std::vector<std::string>{"", "two words", "other"}));
  EXPECT_EQ(mesh.slots, (std::vector<std::uint32_t>{0, 1, 1, 2, 1}));
  EXPECT_EQ(mesh.uv_corners[0][0], geometry::kNoIndex);
  EXPECT_EQ(mesh.normal_corners[3], (geometry::Triangle{0, 0, 0}));
  EXPECT_EQ(mesh.uv_corners[4], (geometry::Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.uvs[3], (geometry::Uv{0.5, 0.0}));
  EXPECT_EQ(mesh.vertices_m[3], (Point3{0, 1, 0}));
  EXPECT_TRUE(parsed("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1 2 3\n").uvs.empty());
}

TEST(MeshObj, KeepsCityCoordinatesInDouble) {
  const TriangleMesh mesh =
      parsed("v 85001.0625 440002.015625 1\nv 85002 440002 1\nv 85002 440003 1\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices_m[0], (Point3{85001.0625, 440002.015625, 1.0}));
}

class Notes final : public LogSink {
 public:
  void info(const std::string&) override {}
  void warn(const std::string& message) override { warnings.push_back(message); }
  std::vector<std::string> warnings;
};

TEST(MeshObj, MaterialLibrariesAreIgnoredWithAWord) {
  Notes notes;
  const TriangleMesh mesh = parsed(
      "mtllib my colours.mtl\nmtllib other.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n", &notes);
  EXPECT_EQ(mesh.slot_names, std::vector<std::string>{"red"});
  ASSERT_EQ(notes.warnings.size(), 1u);
  EXPECT_TRUE(
      notes.warnings[0].ends_with(".obj: its material library 'my colours.mtl' is not used; the document "
                                  "says what each name is made of"));
}

TEST(MeshObj, LargeFacesMustNotCrossThemselves) {
  std::string ring, star;
  const int corners = 1500;
  for (int k = 0; k < corners; ++k) {
    const double a = 2.0 * M_PI * k / corners, b = 2.0 * a;
    ring += "v " + std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " 0\n";
    star +=
        "v " + std::to_string(std::cos(b) + 0.5 * std::cos(a)) + " " + std::to_string(std::sin(b)) + " 0\n";
  }
  std::string face = "f";
  for (int k = 1; k <= corners; ++k) face.append(" ").append(std::to_string(k));
  EXPECT_EQ(parsed(ring + face + "\n").triangles.size(), 1498u);
  EXPECT_NE(message_of(star + face + "\n").find("the outline of this face crosses itself"),
            std::string::npos);
}

TEST(MeshObj, FacesThatRunRoundTwiceCountOnce) {
  EXPECT_EQ(parsed("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 1 2 3 4\n").triangles.size(), 2u);
}

TEST(MeshObj, ErrorsShowThePlace) {
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0 zero\n"),
            ":2:7: expected a finite number, found 'zero'\n  v 1 0 zero\n        ^");
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0\n"), ":2:6: a vertex needs 3 numbers, found 2\n  v 1 0\n       ^");
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
            ":4:7: there is no vertex number 4: the file has 3 so far\n  f 1 2 4\n        ^");
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/2 2 3\n"),
            ":5:5: there is no texture coordinate number 2: the file has 1 so far\n  f 1/2 2 3\n      ^");
  EXPECT_EQ(message_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"),
            ":4:7: there is no vertex number 0: the file has 3 so far\n  f 1 2 0\n        ^");
  EXPECT_EQ(message_of("v 0 0 0\nf 1 1\n"),
            ":2:6: a face needs at least 3 corners, found 2\n  f 1 1\n       ^");
  EXPECT_EQ(message_of("v 0 0 0\nf -4 -3 -2\n"),
            ":2:3: there is no vertex number -4: the file has 1 so far\n  f -4 -3 -2\n    ^");
  EXPECT_EQ(message_of("v 0 nan 0\n"), ":1:5: expected a finite number, found 'nan'\n  v 0 nan 0\n      ^");
  EXPECT_EQ(message_of("f x y z\n"), ":1:3: expected the number of a vertex, found 'x'\n  f x y z\n    ^");
  EXPECT_EQ(message_of("# nothing\n"), ": the file has no faces");
  EXPECT_EQ(message_of("\xfe\xff"), ": the file is in UTF-16; expected plain text (UTF-8)");
  EXPECT_THROW(read_obj("/no/such/file.obj"), SystemError);
}

/// Files that once broke other readers: an error with a place, or a mesh whose indices are all good.
TEST(MeshObj, BrokenFilesNeverPass) {
  const auto folder = test::truth_file("malformed/tinyobj");
  if (!folder) GTEST_SKIP() << "reference data not found: malformed/tinyobj";
  int files = 0, errors = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    SCOPED_TRACE(entry.path().string());
    ++files;
    try {
      const TriangleMesh mesh = read_obj(entry.path());
      for (const auto& t : mesh.triangles)
        for (const std::uint32_t i : t) ASSERT_LT(i, mesh.vertices_m.size());
    } catch (const InputError& e) {
      ++errors;
      EXPECT_NE(std::string(e.what()).find(entry.path().filename().string()), std::string::npos);
    }
  }
  EXPECT_GE(files, 10);
  EXPECT_GE(errors, 5);
}

/// Every good text cut short, and with one byte changed: never a crash, never an index out of range.
TEST(MeshObj, DamagedTextIsHandled) {
  const std::string good =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\nf 1/1/1 2/1/1 \\\n 3/1/1 4/1/1\nf -1 "
      "-2 -3\n";
  int errors = 0;
  const auto attempt = [&](const std::string& text) {
    try {
      const TriangleMesh mesh = parsed(text);
      for (const auto& t : mesh.triangles)
        for (const std::uint32_t i : t) ASSERT_LT(i, mesh.vertices_m.size());
    } catch (const InputError&) {
      ++errors;
    }
  };
  for (std::size_t cut = 0; cut < good.size(); ++cut) attempt(good.substr(0, cut));
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const char c : {'9', '-', '/', ' ', '\n', '\\', '\0', 'f', '\xff'}) {
      std::string text = good;
      text[at] = c;
      attempt(text);
    }
  EXPECT_GT(errors, 100);
}

}  // namespace
}  // namespace ifov::io::test_mesh_obj
