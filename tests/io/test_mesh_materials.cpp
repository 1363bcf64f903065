// Colours and pictures that mesh files tell of their materials.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/mesh_materials.h"
#include "io/raster/picture.h"
#include "scratch_mesh.h"
#include "support/small_pictures.h"

namespace ifov::io::test_mesh_materials {
namespace {

constexpr std::uint32_t cell(std::uint32_t red, std::uint32_t green, std::uint32_t blue,
                             std::uint32_t alpha = 255) {
  return red | green << 8 | blue << 16 | alpha << 24;
}

const FileMaterial& named(const MeshMaterials& all, const std::string& slot) {
  for (const FileMaterial& material : all.materials)
    if (material.slot == slot) return material;
  throw InputError("no slot " + slot);
}

std::string after(const std::string& message, const std::string& name) {
  const std::size_t at = message.find(name);
  return at == std::string::npos ? message : message.substr(at + name.size());
}

TEST(Pictures, AreDecodedWithPalettesAndAlpha) {
  const Picture plain = decode_picture(test::decoded(test::kPicture), "p");
  EXPECT_EQ(plain.cells, (std::vector<std::uint32_t>{cell(200, 40, 40), cell(40, 180, 40), cell(40, 40, 200),
                                                     cell(128, 128, 128)}));
  EXPECT_FALSE(plain.has_alpha);
  const Picture palette = decode_picture(test::decoded(test::kPalettePicture), "p");
  EXPECT_EQ(palette.cells, (std::vector<std::uint32_t>{cell(200, 100, 50), cell(10, 20, 30)}));
  const Picture hole = decode_picture(test::decoded(test::kPictureWithHole), "p");
  EXPECT_TRUE(hole.has_alpha);
  EXPECT_EQ(hole.cells[1], cell(40, 180, 40, 0));
  EXPECT_THROW(decode_picture("no picture at all", "p"), InputError);
  EXPECT_THROW(decode_picture(test::decoded(test::kPicture).substr(0, 40), "p"), InputError);
}

const char* const kFace = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl tile\nf 1/1 2/2 3/3\n";

MeshMaterials of_library(const std::string& library) {
  const test::ScratchMesh mesh("a.obj", std::string("mtllib my colours.mtl\n") + kFace);
  mesh.add("my colours.mtl", library);
  mesh.add("tile.png", test::decoded(test::kPicture));
  return read_mesh_materials(mesh.path());
}

TEST(MaterialLibraries, TellColoursAndPictures) {
  const MeshMaterials all = of_library(
      "# made by hand\nnewmtl tile\nKa 1 1 1\nKd 0.5 0.25 1\nmap_Kd -clamp on tile.png\nd 0.5\n"
      "newmtl grey\nKd 0.2\nTr 0\nnewmtl nothing\nNs 10\nnewmtl lit\nKd 1 0 0\nKe 1 1 1\n");
  EXPECT_EQ(all.materials.size(), 3u);  // of 'nothing' the file says nothing
  EXPECT_FALSE(all.says_coding);
  const FileMaterial& tile = named(all, "tile");
  EXPECT_EQ(tile.colour, (std::array{0.5, 0.25, 1.0}));
  ASSERT_TRUE(tile.picture);
  EXPECT_EQ(tile.picture->cells[0], cell(200, 40, 40));
  EXPECT_EQ(tile.wrap[0], Wrap::edge);
  EXPECT_EQ(tile.alpha, AlphaMode::blend);
  EXPECT_EQ(named(all, "grey").colour, (std::array{0.2, 0.2, 0.2}));
  EXPECT_EQ(named(all, "grey").alpha, AlphaMode::opaque);
  EXPECT_EQ(named(all, "lit").not_used, std::vector<std::string>{"emission"});
}

TEST(MaterialLibraries, ErrorsHaveTheirPlace) {
  const auto said = [](const std::string& library) {
    try {
      of_library(library);
    } catch (const InputError& error) {
      return after(error.what(), "my colours.mtl").substr(0, 60);
    }
    return std::string("nothing");
  };
  EXPECT_TRUE(said("newmtl a\nKd 1 2 0\n").starts_with(":2:6: expected a number from 0 to 1, found '2'"));
  EXPECT_TRUE(said("newmtl a\nKd spectral a.rfl\n").starts_with(":2:4: a colour as 'spectral' is not read"));
  EXPECT_TRUE(said("newmtl a\nmap_Kd gone.png\n").starts_with(":2:8: there is no image '"));
  EXPECT_TRUE(said("newmtl a\nmap_Kd ../a.png\n").starts_with(":2:8: the image '../a.png' does not lie in"));
  EXPECT_TRUE(
      said("newmtl a\nmap_Kd -s 2 2 1 tile.png\n").starts_with(":2:8: the option '-s' of a picture is"));
  EXPECT_TRUE(said("newmtl a\nmap_Kd my colours.mtl\n").starts_with(":2:8:"));
  const test::ScratchMesh without("b.obj", kFace);
  EXPECT_THROW(read_mesh_materials(without.path()), InputError);
  const test::ScratchMesh gone("c.obj", std::string("mtllib gone.mtl\n") + kFace);
  try {
    read_mesh_materials(gone.path());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(after(error.what(), "c.obj").starts_with(":1:8: there is no material library '"))
        << error.what();
  }
}

TEST(MaterialLibraries, TellTheirFiles) {
  const test::ScratchMesh mesh("a.obj", std::string("mtllib a.mtl\n") + kFace);
  mesh.add("a.mtl", "newmtl tile\nmap_Kd tile.png\n");
  EXPECT_EQ(mesh_material_files(mesh.path()).size(), 1u);  // the picture is not there yet
  mesh.add("tile.png", test::decoded(test::kPicture));
  EXPECT_EQ(mesh_material_files(mesh.path()).size(), 2u);
}

TEST(MaterialsOfPly, AreOnePicture) {
  const auto text = [](const std::string& comments) {
    return "ply\nformat ascii 1.0\n" + comments +
           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float "
           "t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 "
           "0 1 2\n";
  };
  const test::ScratchMesh mesh("a.ply", text("comment TextureFile tile.png\n"));
  try {
    read_mesh_materials(mesh.path());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(after(error.what(), "a.ply").starts_with(":3:21: there is no image '")) << error.what();
  }
  mesh.add("tile.png", test::decoded(test::kPicture));
  EXPECT_EQ(named(read_mesh_materials(mesh.path()), "").picture->width, 2);
  const test::ScratchMesh bare("b.ply", text(""));
  EXPECT_THROW(read_mesh_materials(bare.path()), InputError);
}

/// A triangle with two sets of texture coordinates, (0, 0) (1, 0) (0, 0.25) and (0.5, 0.5) thrice, in a data URI.
std::string gltf_text(const std::string& materials, const std::string& more) {
  const float numbers[] = {0, 0, 0, 1,     0,    0,    0,    1,    0,    0,   0,
                           1, 0, 0, 0.25f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
  const std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned word = 0;
    for (std::size_t b = 0; b < 3; ++b) word = word << 8 | static_cast<unsigned char>(bytes[k + b]);
    for (int digit = 3; digit >= 0; --digit) base64 += kDigits[word >> (6 * digit) & 63u];
  }
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 2}, "material": 0}]}],
  "materials": [)" +
         materials + R"(],
  "buffers": [{"uri": "data:application/octet-stream;base64,)" +
         base64 + R"(", "byteLength": 84}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
    {"buffer": 0, "byteOffset": 60, "byteLength": 24}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
    {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"}])" +
         more + "}";
}
std::string textured(const std::string& texture, const std::string& more = {}) {
  return R"({"name": "tile", "alphaMode": "MASK", "pbrMetallicRoughness": {"metallicFactor": 0,
    "baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0)" +
         texture + "}}}" + more;
}
std::string picture_of(const std::string& image) {
  return R"(, "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33071, "wrapT": 33648}],
  "images": [)" +
         image + "]";
}
const std::string kInline =
    picture_of("{\"uri\": \"data:image/png;base64," + std::string(test::kPictureWithHole) + "\"}");

/// As the material's colour, where they are all alike.
TEST(MaterialsOfGltf, HaveTheColourOfTheirVertices) {
  const auto tile = [](const char* colours) {
    std::string text = gltf_text(textured(""), kInline);
    const std::string set = "\"TEXCOORD_1\": 2", accessors = "\"accessors\": [";
    if (colours != nullptr) text.replace(text.find(set), set.size(), colours);
    // Six numbers of 0.5 in threes, and the triangle's coordinates less one.
    text.replace(text.find(accessors), accessors.size(), R"("accessors": [
      {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"},)");
    for (const char* name : {"\"POSITION\": 0", "\"TEXCOORD_0\": 1"}) {
      const std::string from = name;
      std::string to = from;
      ++to.back();
      text.replace(text.find(from), from.size(), to);
    }
    const test::ScratchMesh file("a.gltf", text);
    return named(read_mesh_materials(file.path()), "tile");
  };
  EXPECT_EQ(tile(R"("COLOR_0": 0)").colour, (std::array{0.25, 0.5, 0.5}));
  EXPECT_TRUE(tile(R"("COLOR_0": 0)").not_used.empty());
  EXPECT_EQ(tile(nullptr).colour, (std::array{0.5, 1.0, 1.0}));
  EXPECT_TRUE(tile(nullptr).not_used.empty());
  EXPECT_EQ(tile(R"("COLOR_0": 1)").colour, (std::array{0.5, 1.0, 1.0}));
  EXPECT_EQ(tile(R"("COLOR_0": 1)").not_used,
            std::vector<std::string>{"colours that differ from vertex to vertex (COLOR_0)"});
  try {
    tile(R"("COLOR_0": 2)");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(
        after(error.what(), "a.gltf").starts_with(": accessor 2 (COLOR_0): its type does not suit its use"))
        << error.what();
  }
}

TEST(MaterialsOfGltf, AreBaseColours) {
  const test::ScratchMesh file("a.gltf", gltf_text(textured("", R"(, {"name": "tile"}, {})"), kInline));
  const MeshMaterials all = read_mesh_materials(file.path());
  EXPECT_TRUE(all.says_coding);
  const FileMaterial& tile = named(all, "tile");
  EXPECT_EQ(tile.colour, (std::array{0.5, 1.0, 1.0}));
  EXPECT_EQ(tile.wrap[0], Wrap::edge);
  EXPECT_EQ(tile.wrap[1], Wrap::mirror);
  EXPECT_EQ(tile.alpha, AlphaMode::mask);
  EXPECT_EQ(tile.alpha_cutoff, 0.5);
  EXPECT_EQ(tile.picture->cells[1], cell(40, 180, 40, 0));
  // Materials of one name are two, with materials of the file.
  EXPECT_FALSE(named(all, "tile (material 1)").picture);
  EXPECT_EQ(named(all, "material 2").colour, (std::array{1.0, 1.0, 1.0}));
  const test::ScratchMesh beside("b.gltf",
                                 gltf_text(textured(""), picture_of(R"({"uri": "my%20tile.png"})")));
  beside.add("my tile.png", test::decoded(test::kPicture));
  EXPECT_EQ(named(read_mesh_materials(beside.path()), "tile").picture->cells[3], cell(128, 128, 128));
  EXPECT_EQ(mesh_material_files(beside.path()).size(), 1u);
}

TEST(MaterialsOfGltf, PicturesLieByTheirOwnCoordinates) {
  const auto uvs = [](const std::string& texture, MeshUse use) {
    const test::ScratchMesh file("a.gltf", gltf_text(textured(texture), kInline));
    return read_gltf(file.path(), nullptr, use).uvs;
  };
  const std::string moved =
      R"(, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "scale": [2, 4]}})";
  // v of the file runs down, ours up; without materials nothing is moved.
  EXPECT_EQ(uvs(moved, MeshUse::shape)[2], (geometry::Uv{0.0, 0.75}));
  EXPECT_EQ(uvs(moved, MeshUse::with_materials)[2], (geometry::Uv{0.25, 1.0 - (0.5 + 4 * 0.25)}));
  EXPECT_EQ(uvs(moved, MeshUse::with_materials)[1], (geometry::Uv{2.25, 0.5}));
  EXPECT_EQ(uvs(R"(, "texCoord": 1)", MeshUse::with_materials)[1], (geometry::Uv{0.5, 0.5}));
  EXPECT_EQ(uvs(R"(, "texCoord": 1)", MeshUse::shape)[1], (geometry::Uv{1.0, 1.0}));
  // Counter-clockwise with v downwards: (1, 0) comes to (0, -1).
  const auto turned =
      uvs(R"(, "extensions": {"KHR_texture_transform": {"rotation": 1.5707963267948966, "texCoord": 0}})",
          MeshUse::with_materials);
  EXPECT_NEAR(turned[1].u, 0.0, 1e-12);
  EXPECT_NEAR(1.0 - turned[1].v, -1.0, 1e-12);
  // A set that is not there: the triangles have no coordinates.
  EXPECT_TRUE(uvs(R"(, "texCoord": 5)", MeshUse::with_materials).empty());
}

TEST(MaterialsOfGltf, ErrorsSayWhatIsWrong) {
  const auto said = [](const std::string& materials, const std::string& more) {
    const test::ScratchMesh file("a.gltf", gltf_text(materials, more));
    try {
      read_mesh_materials(file.path());
    } catch (const InputError& error) {
      return after(error.what(), "a.gltf");
    }
    return std::string("nothing");
  };
  EXPECT_EQ(said(textured(""), R"(, "images": [])"), ": material 0 names texture 0: the file has 0");
  EXPECT_EQ(said(textured(""), R"(, "textures": [{"source": 3}])"),
            ": texture 0 names image 3: the file has 0");
  EXPECT_EQ(said(textured(""), R"(, "textures": [{}])"),
            ": texture 0 has no image of a kind that is read (PNG, JPEG)");
  EXPECT_TRUE(
      said(textured(""), picture_of(R"({"uri": "gone.png"})")).starts_with(": image 0: there is no image '"));
  EXPECT_TRUE(said(textured(""), picture_of(R"({"uri": "/etc/passwd"})"))
                  .starts_with(": image 0: the image '/etc/passwd' does not lie in the folder"));
  EXPECT_TRUE(said(textured(""), picture_of(R"({"uri": "data:image/png;base64,AAAA"})"))
                  .starts_with(": image 0: not an image of a kind that is read"));
  EXPECT_TRUE(said(R"({"pbrMetallicRoughness": {"baseColorFactor": [2, 1, 1, 1]}})", "")
                  .starts_with(": material 0: baseColorFactor holds 2; expected 0 to 1"));
}

}  // namespace
}  // namespace ifov::io::test_mesh_materials
