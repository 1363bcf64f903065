#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "ifov/ifov.h"
#include "named_files.h"

namespace facade_test::test_file_assets {
namespace {

namespace fs = std::filesystem;

/// "csv" of "CSV spectrum" and so on, of all sections of the reference of documents.
std::set<std::pair<std::string, std::string>> keys_of_files() {
  std::set<std::pair<std::string, std::string>> keys;
  std::istringstream lines(ifov::document_reference());
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) section = line.substr(3);
    if (!line.starts_with("| `") || line.find("file name") == std::string::npos) continue;
    keys.emplace(section, line.substr(3, line.find('`', 3) - 3));
  }
  return keys;
}

class FileAssets : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("ifov_file_assets_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ifov::Document document(const Named& named, const std::string& prefix) const {
    return ifov::Document::parse(named.document(prefix), "scene.json", folder_);
  }
  static ifov::Document with(const ifov::Document& document,
                             const std::map<std::string, std::string>& files) {
    ifov::Assets assets;
    for (const auto& [name, bytes] : files) assets.add(name, ifov::FileAsset{bytes});
    return document.with_assets(assets);
  }
  /// All that is said, with names as if everything were in a file.
  std::string said(const ifov::Document& document) const {
    std::string all;
    for (const ifov::Message& message : ifov::check(document))
      all += std::to_string(static_cast<int>(message.severity)) + " " + message.text + "\n";
    return replaced_all(replaced_all(all, "asset:", ""), folder_.string() + "/", "");
  }
  static ifov::Severity gravest_of(const std::string& said) {
    ifov::Severity gravest{};
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
      if (line.size() > 1 && line[1] == ' ' && line[0] >= '0' && line[0] <= '9')
        gravest = std::max(gravest, static_cast<ifov::Severity>(line[0] - '0'));
    return gravest;
  }
  /// Of a raster whose driver this build left out (IFOV_GDAL_DRIVERS).
  static bool not_read(const std::string& said) {
    return said.find("not a raster of a kind that is read") != std::string::npos;
  }
  static bool refuses(const ifov::Document& document) {
    return ifov::check(document).back().severity >= ifov::Severity::error;
  }

  fs::path folder_;
};

/// Radiances of a document's image, one after the other.
class Values final : public ifov::TileSink {
 public:
  void write(const ifov::Tile& tile) override { radiance.assign(tile.radiance.begin(), tile.radiance.end()); }
  std::vector<float> radiance;
};

std::vector<float> values_of(const ifov::Document& document) {
  Values values;
  ifov::Simulation::load(document).render_tiles(values);
  return values.radiance;
}

/// Whatever key names a file takes its bytes from memory, and they are looked at: other ones are refused.
TEST_F(FileAssets, StandForEveryFileThatADocumentNames) {
  std::set<std::pair<std::string, std::string>> keys = keys_of_files();
  EXPECT_EQ(keys.erase({"document", "include"}), 1u);  // read with the document, before there are assets
  keys.erase({"USGS spectrum", "wavelengths"});        // beside `usgs`
  for (const Named& named : all_named()) {
    SCOPED_TRACE(named.section + ": " + named.key);
    keys.erase({named.section, named.key});
    for (const auto& [name, bytes] : named.files) std::ofstream(folder_ / name, std::ios::binary) << bytes;
    const ifov::Document from_files = document(named, ""), from_memory = document(named, "asset:");
    const std::string of_files = said(from_files);
    if (not_read(of_files)) continue;
    EXPECT_LT(gravest_of(of_files), ifov::Severity::error) << of_files;
    EXPECT_EQ(said(with(from_memory, named.files)), of_files);
    EXPECT_EQ(values_of(with(from_memory, named.files)), values_of(from_files));
    for (const auto& [name, bytes] : named.files) {
      std::map<std::string, std::string> other = named.files;
      other[name] = "1,?\n";
      EXPECT_TRUE(refuses(with(from_memory, other))) << name;
    }
    for (const auto& [name, bytes] : named.files) fs::remove(folder_ / name);
  }
  for (const auto& [section, key] : keys) ADD_FAILURE() << section << ": " << key << " is not tried";
}

TEST_F(FileAssets, ErrorsAreThoseOfFilesAndTellWhatIsThere) {
  Named mesh = named(all_named(), "mesh");
  const auto named_as = [&](const char* shape) {
    mesh.parts.object = std::string("{") + shape + R"(, "material": "m"})";
  };
  named_as(R"("mesh": {"file": "FILEa"})");
  mesh.files = {{"a", "v 0 0 0\n"}};
  EXPECT_NE(said(with(document(mesh, "asset:"), mesh.files)).find("cannot tell the format of the mesh 'a'"),
            std::string::npos);
  named_as(R"("mesh": {"file": "FILEa.gltf"})");
  mesh.files = {
      {"a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "b.bin", "byteLength": 4}]})"},
      {"b.bin", "0000"}};
  const std::string outside = said(with(document(mesh, "asset:"), mesh.files));
  EXPECT_NE(outside.find("found the buffer 'b.bin'; expected those of a mesh in memory within it"),
            std::string::npos)
      << outside;
  named_as(R"("city": {"file": "FILEa"})");
  ifov::Assets assets;
  assets.add("a", ifov::SpectrumAsset{{1.0, 2.0}, {0.5, 0.5}});
  const std::string other = said(document(mesh, "asset:").with_assets(assets));
  EXPECT_NE(other.find("'a' is a spectrum of 2 wavelengths; expected a file"), std::string::npos) << other;
  EXPECT_THROW(ifov::Document::parse(R"({"ifov": 1, "include": "asset:a"})", "scene.json", folder_),
               ifov::InputError);
}

/// What stands beside a file counts in the checksums of a run, too.
TEST_F(FileAssets, ARunTellsOfThemAndOfWhatIsBesideThem) {
  const Named normals = named(all_named(), "relief of normals");
  const ifov::Document document_of_them = with(document(normals, "asset:"), normals.files);
  if (not_read(said(document_of_them)))
    GTEST_SKIP() << "built without GDAL's driver ENVI (IFOV_GDAL_DRIVERS)";
  ifov::Simulation::load(with(document(normals, "asset:"), normals.files))
      .render({.folder = folder_ / "out"});
  std::string notes;
  for (const std::string& note : ifov::run_info(folder_ / "out" / "image_run.json").notes)
    notes += note + "\n";
  for (const char* name : {"n.img", "n.hdr"})
    EXPECT_NE(notes.find("'asset:" + std::string(name) + "' came from a program's memory"), std::string::npos)
        << notes;
}

/// The arrays of a spectrum are a channel's response, too.
TEST_F(FileAssets, ASpectrumIsATableOfAChannel) {
  Named channel = named(all_named(), "tabulated channel");
  channel.parts.channel = R"({"name": "c", "tabulated": {"file": "FILEa.csv", "wavelength_unit": "nm"}})";
  std::ofstream(folder_ / "a.csv") << "490,0\n500,1\n510,0.25\n520,0\n";
  ifov::Assets assets;
  assets.add("a.csv", ifov::SpectrumAsset{{490, 500, 510, 520}, {0, 1, 0.25, 0}});
  const std::vector<float> from_memory = values_of(document(channel, "asset:").with_assets(assets));
  EXPECT_EQ(from_memory, values_of(document(channel, "")));
  assets.add("a.csv", ifov::SpectrumAsset{{490, 500, 510, 520}, {0, 1, 0.75, 0}});
  EXPECT_NE(from_memory, values_of(document(channel, "asset:").with_assets(assets)));
}

}  // namespace
}  // namespace facade_test::test_file_assets
