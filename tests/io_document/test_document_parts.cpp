#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/format.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"

namespace ifov::io::test_document_parts {
namespace {

const char* const kBase = R"({
  "ifov": 1,
  "scene": {"materials": {"lawn": {"reflectance": 0.2}, "wall": {"reflectance": 0.5}},
            "objects": [{"plane": {}, "material": "lawn"},
                        {"mesh": {"file": "house.obj"}, "material": "wall"}]},
  "light": {"sky": {"radiance": "50 W m-2 sr-1 um-1"}, "sun": {"disc": {"zenith": "30 deg", "azimuth": "90 deg"}}},
  "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 4]}},
             "channels": [{"name": "red", "monochromatic": {"at": "0.65 um"}}]}
})";

class DocumentParts : public ::testing::Test {
 protected:
  DocumentParts()
      : folder_(std::filesystem::path(::testing::TempDir()) / format("ifov_document_parts_{}", getpid())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "shared");
    write("shared/base.json", kBase);
    write("shared/house.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  ~DocumentParts() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Document read(const std::string& text, std::vector<std::string> set = {}) const {
    write("scene.json", text);
    std::vector<DocumentOverride> overrides;
    for (const std::string& one : set) overrides.push_back(read_override(one));
    return read_document(path("scene.json"), overrides);
  }
  std::string message(const std::string& text, std::vector<std::string> set = {}) const {
    try {
      read(text, std::move(set));
    } catch (const InputError& error) {
      std::string said = error.what();
      for (std::size_t at; (at = said.find(folder_.string() + "/")) != std::string::npos;)
        said.erase(at, folder_.string().size() + 1);
      return said;
    }
    return "no error";
  }
  static double gsd_m(const Document& document) {
    return camera_as<OrthographicCamera>(document.sensor.camera)->gsd_m;
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(DocumentParts, ObjectsArePutTogetherKeyByKey) {
  const Document document = read(R"({"include": "shared/base.json",
    "sensor": {"camera": {"orthographic": {"gsd": "2 m"}}}, "light": {"sun": null}})");
  EXPECT_EQ(gsd_m(document), 2.0);
  EXPECT_EQ(camera_as<OrthographicCamera>(document.sensor.camera)->size.width_px, 4);
  EXPECT_FALSE(document.light.sun);
  EXPECT_EQ(document.scene.objects.size(), 2u);
  EXPECT_EQ(document.output.folder, path("scene.out"));
}

TEST_F(DocumentParts, FilesBelongToTheDocumentThatNamesThem) {
  const Document document = read(R"({"include": "shared/base.json"})");
  EXPECT_EQ(document.files, (std::vector<std::string>{path("shared/house.obj"), path("shared/base.json")}));
  EXPECT_NE(document.text->find("\"shared/house.obj\""), std::string::npos);
  // The whole text is a document beside the first that says the same.
  const Document again = parse_document(*document.text, path("scene.json"));
  EXPECT_EQ(again.files, (std::vector<std::string>{path("shared/house.obj")}));
  EXPECT_EQ(*again.text, *document.text);
}

// A document that is included may lie anywhere; where products appear is not for it to say.
TEST_F(DocumentParts, ProductsLieBesideTheDocumentThatIsRendered) {
  write("shared/out.json", R"({"output": {"folder": "runs"}})");
  EXPECT_EQ(read(R"({"include": ["shared/base.json", "shared/out.json"]})").output.folder, path("runs"));
  EXPECT_EQ(read(kBase, {"output.folder=elsewhere"}).output.folder, path("elsewhere"));
}

TEST_F(DocumentParts, ListsAreReplaced) {
  const Document document =
      read(R"({"include": "shared/base.json", "scene": {"objects": [{"plane": {}, "material": "wall"}]}})");
  ASSERT_EQ(document.scene.objects.size(), 1u);
}

TEST_F(DocumentParts, TheLastOfSeveralCountsMost) {
  write("one.json", R"({"sensor": {"camera": {"orthographic": {"gsd": "3 m"}}}, "seed": 5})");
  write("two.json", R"({"sensor": {"camera": {"orthographic": {"gsd": "4 m"}}}})");
  const Document document = read(R"({"include": ["shared/base.json", "one.json", "two.json"]})");
  EXPECT_EQ(gsd_m(document), 4.0);
  EXPECT_EQ(document.seed, 5u);
}

TEST_F(DocumentParts, ErrorsShowTheFileWhereTheValueStands) {
  write("bad.json", "{\n \"sensor\": {\"camera\": {\"orthographic\": {\"gsd\": 3}}}\n}");
  EXPECT_EQ(message(R"({"include": ["shared/base.json", "bad.json"]})").substr(0, 87),
            "bad.json:2:48: 'sensor.camera.orthographic.gsd' is the number 3 without a unit, expecte");
  EXPECT_NE(
      message(R"({"include": ["shared/base.json", "bad.json"]})").find("    2 |  \"sensor\": {\"camera\""),
      std::string::npos);
}

TEST_F(DocumentParts, CirclesAndMissingFilesAreNamedWhereTheyAreIncluded) {
  write("round.json", R"({"include": "scene.json"})");
  EXPECT_EQ(message(R"({"include": "round.json"})").substr(0, 46),
            "round.json:1:13: 'scene.json' includes itself\n");
  EXPECT_EQ(message(R"({"include": "gone.json"})").substr(0, 39), "scene.json:1:13: cannot read 'gone.json");
  EXPECT_EQ(
      message(R"({"include": 3})").substr(0, 99),
      "scene.json:1:13: 'include' is the number 3, expected the name of a document, or a list of them\n    ");
}

TEST_F(DocumentParts, OverridesReplaceWholeValues) {
  const Document document =
      read(kBase, {"sensor.camera.orthographic.gsd=7 m",
                   "light.sun.disc={\"zenith\": \"10 deg\", \"azimuth\": \"0 deg\"}",
                   "scene.objects[1]={\"plane\": {\"height\": \"1 m\"}, \"material\": \"wall\"}", "seed=9"});
  EXPECT_EQ(gsd_m(document), 7.0);
  EXPECT_EQ(document.seed, 9u);
  EXPECT_TRUE(is_primitive(document.scene.objects[1].shape, PlanePrimitive::kModel));
  EXPECT_FALSE(read(kBase, {"light.sun=null"}).light.sun);
  EXPECT_EQ(gsd_m(read(kBase, {"sensor.camera.orthographic={\"gsd\": \"1 m\", \"pixels\": [2, 2]}",
                               "sensor.camera.orthographic.gsd=6 m"})),
            6.0);
}

TEST_F(DocumentParts, OverridesTakeItemsOfListsAway) {
  const Document whole = read(kBase), rest = read(kBase, {"scene.objects[0]=null"});
  ASSERT_EQ(whole.scene.objects.size(), 2u);
  ASSERT_EQ(rest.scene.objects.size(), 1u);
  EXPECT_EQ(rest.scene.objects[0].position.line, whole.scene.objects[1].position.line);
  // Numbers go on counting what was written.
  EXPECT_TRUE(is_primitive(
      read(kBase, {"scene.objects[0]=null", "scene.objects[1]={\"plane\": {}, \"material\": \"wall\"}"})
          .scene.objects[0]
          .shape,
      PlanePrimitive::kModel));
  EXPECT_EQ(message(kBase, {"scene.objects[0]=null", "scene.objects[2]=null"}),
            "--set scene.objects[2]: 'scene.objects' has 2 items, counted from 0");
  EXPECT_NE(message(kBase, {"scene.objects[0]=null", "scene.objects[1].material=none such"})
                .find("there is no material 'none such'"),
            std::string::npos);
}

TEST_F(DocumentParts, WrongOverridesAreErrors) {
  EXPECT_EQ(
      message(kBase, {"sensor.camera.orthographic.gsd=7"}).substr(0, 107),
      "--set sensor.camera.orthographic.gsd:1:1: 'sensor.camera.orthographic.gsd' is the number 7 without a unit, ");
  EXPECT_EQ(message(kBase, {"sensor.camera.orthographic.gds=7 m"}).substr(0, 80),
            "--set sensor.camera.orthographic.gds:1:1: unknown key 'gds' in 'sensor.camera.or");
  EXPECT_EQ(message(kBase, {"scene.objects[2].material=lawn"}),
            "--set scene.objects[2].material: 'scene.objects' has 2 items, counted from 0");
  EXPECT_EQ(
      message(kBase, {"scene.objects.material=lawn"}),
      "--set scene.objects.material: 'scene.objects' is a list of 2, not an object; its first item is scene.objects[0]");
  const std::string how =
      "; expected a key and its value, such as sensor.camera.orthographic.gsd=\"2 m\" or scene.objects[0].material=lawn";
  EXPECT_EQ(message(kBase, {"seed"}), "--set seed: there is no '='" + how);
  EXPECT_EQ(message(kBase, {"a..b=1"}), "--set a..b=1: a key is empty" + how);
  EXPECT_EQ(message(kBase, {"a[x]=1"}), "--set a[x]=1: '[' needs a number and ']'" + how);
  EXPECT_EQ(message(kBase, {"[0]=1"}), "--set [0]=1: a document has keys, and is no list" + how);
  EXPECT_EQ(message(kBase, {"seed="}), "--set seed=: there is no value" + how);
}

}  // namespace
}  // namespace ifov::io::test_document_parts
