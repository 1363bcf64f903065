// Meshes with the materials of their files: images against the colours of a picture, and what is said of the guess.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "radiometry/colour/upsampling.h"
#include "render/image_renderer.h"
#include "render/tile_sink.h"
#include "sampling/tile.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "support/small_pictures.h"

namespace ifov::session::test_textured_meshes {
namespace {

class TileOfTextures final : public render::TileSink {
 public:
  void begin(const render::ImageInfo&) override {}
  void write(const sampling::TileResult& tile) override { result = tile; }
  sampling::TileResult result;
};

class TexturedMeshes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_textured_{}", getpid());
    std::filesystem::create_directories(folder_);
    write("tex.png", test::decoded(test::kPicture));
    write("quad.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd tex.png\nnewmtl plain\nKd 0.2 0.5 0.1\n");
    write("quad.obj", std::string("mtllib quad.mtl\nusemtl paint\n") + kQuad);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }

  Session load(const std::string& objects, const std::string& channels = kColours,
               const std::string& sampling = R"({"grid": {"elements": [2, 2]}})", int pixels = 2,
               const std::string& prototypes = "") const {
    return Session::load(
        io::parse_document(
            format(
                "{{\"ifov\": 1, \"scene\": {{\"materials\": {{\"black\": {{\"reflectance\": 0}}, \"half\": {{\"reflectance\": "
                "0.5}}, \"red\": {{\"reflectance\": 0.9}}}},\n {} \"objects\": [{}]}},\n \"light\": {{\"sky\": {{\"radiance\": "
                "\"100 W m-2 sr-1 um-1\"}}}},\n \"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"{} m\", "
                "\"pixels\": [{}, {}]}}}},\n  \"channels\": [{}]}},\n \"sampling\": {}}}",
                prototypes, objects, 10.0 / pixels, pixels, pixels, channels, sampling),
            (folder_ / "scene.json").string()),
        nullptr);
  }
  static sampling::TileResult rendered(const Session& session) {
    render::RenderControl control;
    control.threads = 1;
    TileOfTextures tile;
    render::render_image(session.parts().job(), control, tile);
    return tile.result;
  }
  std::string said(const std::string& objects) const {
    try {
      load(objects);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing";
  }
  static std::string warnings(const Session& session) {
    std::string all;
    for (const std::string& warning : session.parts().warnings) all += warning + "\n";
    return all;
  }

  static constexpr const char* kQuad =
      "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
  static constexpr const char* kColours =
      R"({"name": "blue", "monochromatic": {"at": "0.45 um"}}, {"name": "green", "monochromatic": {"at": "0.55 um"}},
         {"name": "red", "monochromatic": {"at": "0.65 um"}})";
  static constexpr const char* kFromFile = R"({"mesh": {"file": "quad.obj"}, "material": {"from_file": {}}})";
  std::filesystem::path folder_;
};

/// Of the three channels of a pixel.
double channel_sum(const sampling::TileResult& image, std::size_t pixel) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) sum += static_cast<double>(image.mean[pixel * 3 + c]);
  return sum;
}

TEST_F(TexturedMeshes, ShowThePictureUpright) {
  // 81 channels at the wavelengths that colours are told by: what the image shows, seen under D65, is the picture's colour again.
  std::string channels;
  for (const double um : radiometry::colour_wavelengths_um())
    channels += format("{}{{\"name\": \"c{:.0f}\", \"monochromatic\": {{\"at\": \"{} um\"}}}}",
                       channels.empty() ? "" : ", ", 1e3 * um, um);
  const sampling::TileResult image = rendered(load(kFromFile, channels));
  const int codes[4][3] = {{200, 40, 40}, {40, 180, 40}, {40, 40, 200}, {128, 128, 128}};
  const std::size_t count = radiometry::colour_wavelengths_um().size();
  ASSERT_EQ(image.mean.size(), 4 * count);
  for (std::size_t pixel = 0; pixel < 4; ++pixel) {
    radiometry::LinearRgb seen{}, wrong{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < count; ++k) {
        seen[c] +=
            radiometry::srgb_weights()[c][k] * static_cast<double>(image.mean[pixel * count + k]) / 100.0;
        wrong[c] += radiometry::srgb_weights()[c][k] *
                    static_cast<double>(image.mean[(3 - pixel) * count + k]) / 100.0;
      }
    }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c], radiometry::srgb_decoded(codes[pixel][c] / 255.0), 2e-5) << pixel << " " << c;
    EXPECT_GT(radiometry::colour_difference(seen, wrong), 10.0) << "a picture upside down must be seen";
  }
}

TEST_F(TexturedMeshes, MeansOfPixelsAreThoseOfThePicture) {
  const sampling::TileResult cells = rendered(load(kFromFile));
  const sampling::TileResult one =
      rendered(load(kFromFile, kColours, R"({"accuracy": {"error": "1 %", "confidence": 0.95}})", 1));
  for (std::size_t c = 0; c < 3; ++c) {
    double mean = 0.0;
    for (std::size_t pixel = 0; pixel < 4; ++pixel)
      mean += static_cast<double>(cells.mean[pixel * 3 + c]) / 4.0;
    EXPECT_NEAR(static_cast<double>(one.mean[c]), mean, 0.01 * mean + 1e-9) << c;
  }
}

TEST_F(TexturedMeshes, CopiesOfAPrototypeHaveThePictureEach) {
  const sampling::TileResult alone = rendered(load(kFromFile));
  const sampling::TileResult copies = rendered(
      load(R"({"instances": {"of": "p", "at": [["0 m", "0 m", "0 m"]]}})", kColours,
           R"({"grid": {"elements": [2, 2]}})", 2, format("\"prototypes\": {{\"p\": [{}]}},", kFromFile)));
  ASSERT_EQ(alone.mean.size(), copies.mean.size());
  for (std::size_t k = 0; k < alone.mean.size(); ++k) EXPECT_EQ(alone.mean[k], copies.mean[k]) << k;
}

TEST_F(TexturedMeshes, PlainColoursAreOneSpectrum) {
  write("plain.obj", std::string("mtllib quad.mtl\nusemtl plain\n") + kQuad);
  const sampling::TileResult image =
      rendered(load(R"({"mesh": {"file": "plain.obj"}, "material": {"from_file": {}}})"));
  const radiometry::ColourSpectrum made = radiometry::upsampled({0.2, 0.5, 0.1});
  const double um[] = {0.45, 0.55, 0.65};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(static_cast<double>(image.mean[c]), 100.0 * made.at(um[c]), 1e-3);
}

TEST_F(TexturedMeshes, ColoursStandForMaterials) {
  const Session session = load(
      R"({"mesh": {"file": "quad.obj"}, "material": {"from_file": {"colours": [{"srgb": [210, 35, 45], "material": "red"},
         {"srgb": [40, 180, 40], "material": "half"}, {"srgb": [45, 45, 195], "material": "black"}]}}})");
  const sampling::TileResult image = rendered(session);
  EXPECT_NEAR(channel_sum(image, 0), 270.0, 1e-3);
  EXPECT_NEAR(channel_sum(image, 1), 150.0, 1e-3);
  EXPECT_NEAR(channel_sum(image, 2), 0.0, 1e-3);
  // Grey is unlike all of them, and that is said.
  EXPECT_NE(warnings(session).find("25 % of its cells look unlike every colour that is given"),
            std::string::npos)
      << warnings(session);
  EXPECT_EQ(warnings(session).find("is a guess: made of colours"), std::string::npos) << warnings(session);
}

TEST_F(TexturedMeshes, SlotsOfTheDocumentGoBeforeTheFile) {
  const sampling::TileResult image = rendered(
      load(R"({"mesh": {"file": "quad.obj"}, "material": {"from_file": {"slots": {"paint": "half"}}}})"));
  for (std::size_t pixel = 0; pixel < 4; ++pixel) EXPECT_NEAR(channel_sum(image, pixel), 150.0, 1e-3);
}

TEST_F(TexturedMeshes, TheGuessIsSaid) {
  const std::string three = std::string(kColours) +
                            R"(, {"name": "nir", "top_hat": {"from": "0.8 um", "to": "0.9 um"}},
         {"name": "heat", "top_hat": {"from": "10 um", "to": "12 um"}})";
  const std::string warm =
      R"({"mesh": {"file": "quad.obj"}, "temperature": "20 degC", "material": {"from_file": {)";
  const std::string all = warnings(load(warm + "}}}", three));
  EXPECT_NE(all.find("the reflectance of 'paint' of 'quad.obj' is a guess"), std::string::npos) << all;
  EXPECT_NE(all.find("in 'nir' the reflectance of 'paint' of 'quad.obj' is that of the nearest end"),
            std::string::npos);
  EXPECT_NE(all.find("EMISSIVITY FROM A COLOUR: in 'heat' the emissivity"), std::string::npos);
  // What the document says beyond the visible is no guess of the program, and counts.
  const Session given = load(warm + R"("reflectance_beyond": 0.05}}})", three);
  EXPECT_EQ(warnings(given).find("nearest end"), std::string::npos);
  EXPECT_EQ(warnings(given).find("EMISSIVITY"), std::string::npos);
  const sampling::TileResult image = rendered(given);
  for (std::size_t pixel = 0; pixel < 4; ++pixel)
    EXPECT_NEAR(static_cast<double>(image.mean[pixel * 5 + 3]), 5.0, 1e-3);
  EXPECT_EQ(warnings(load(kFromFile)).find("nearest end"), std::string::npos);
}

TEST_F(TexturedMeshes, HolesShowWhatLiesBehind) {
  const auto below = [](const char* mesh, const char* from = "{}") {
    return format(
        R"({{"mesh": {{"file": "{}"}}, "material": {{"from_file": {}}}}}, {{"polygon": {{"vertices": [["-9 m", "-9 m", "-1 m"],
           ["9 m", "-9 m", "-1 m"], ["9 m", "9 m", "-1 m"], ["-9 m", "9 m", "-1 m"]]}}, "material": "black"}})",
        mesh, from);
  };
  const Session whole = load(below("quad.obj"));
  write("hole.png", test::decoded(test::kPictureWithHole));
  write("quad.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd tex.png\nmap_d hole.png\n");
  const Session cut = load(below("quad.obj"));
  EXPECT_EQ(warnings(cut).find("transparent"), std::string::npos) << warnings(cut);
  const sampling::TileResult all = rendered(whole), image = rendered(cut);
  for (const std::size_t pixel : {0u, 2u, 3u})
    EXPECT_NEAR(channel_sum(image, pixel), channel_sum(all, pixel), 1e-3) << pixel;
  EXPECT_EQ(channel_sum(image, 1), 0.0);
  EXPECT_GT(channel_sum(all, 1), 10.0);
  // So it is where colours stand for materials, and not where a slot is given another.
  const sampling::TileResult classes = rendered(load(below(
      "quad.obj",
      R"({"colours": [{"srgb": [210, 35, 45], "material": "red"}, {"srgb": [128, 128, 128], "material": "half"}]})")));
  EXPECT_EQ(channel_sum(classes, 1), 0.0);
  EXPECT_GT(channel_sum(classes, 0), 100.0);
  EXPECT_GT(channel_sum(rendered(load(below("quad.obj", R"({"slots": {"paint": "half"}})"))), 1), 100.0);
  // Blue is dark in red, and grey between.
  write("quad.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd tex.png\nmap_d -imfchan r tex.png\n");
  const Session red = load(below("quad.obj"));
  const sampling::TileResult by_red = rendered(red);
  EXPECT_GT(channel_sum(by_red, 0), 10.0);
  EXPECT_EQ(channel_sum(by_red, 2), 0.0);
  EXPECT_NE(
      warnings(red).find(
          "'paint' of 'quad.obj': 100 % of it is transparent in part in the file (BLEND), which is not rendered"),
      std::string::npos)
      << warnings(red);
  write("quad.mtl", "newmtl paint\nKd 1 1 1\nd 0.9\n");
  EXPECT_NE(warnings(load(kFromFile)).find("100 % of it is transparent in part"), std::string::npos);
  write("quad.mtl", "newmtl paint\nKd 1 1 1\nd 0\n");
  EXPECT_EQ(channel_sum(rendered(load(below("quad.obj"))), 0), 0.0);
}

TEST_F(TexturedMeshes, MistakesAreShown) {
  write("bare.obj", "mtllib quad.mtl\nusemtl paint\nv -5 -5 0\nv 5 -5 0\nv 5 5 0\nf 1 2 3\n");
  const auto of = [&](const std::string& file, const std::string& from = "{}") {
    return said(R"({"mesh": {"file": ")" + file + R"("}, "material": {"from_file": )" + from + "}}");
  };
  EXPECT_NE(of("bare.obj")
                .find("the slot 'paint' of 'bare.obj' has the picture 'tex.png', but 1 of its triangles "
                      "have no texture coordinates"),
            std::string::npos)
      << of("bare.obj");
  write("other.obj", std::string("mtllib quad.mtl\nusemtl unknown\n") + kQuad);
  EXPECT_NE(
      of("other.obj")
          .find("'quad.mtl' says no colour of the slot 'unknown' of the mesh (it has 'paint', 'plain')"),
      std::string::npos)
      << of("other.obj");
  EXPECT_NE(said(R"({"plane": {}, "material": {"from_file": {}}})")
                .find("only a mesh has materials 'from_file', those that its file tells"),
            std::string::npos);
  EXPECT_NE(of("quad.obj", R"({"slots": {"paint": "gone"}})").find("there is no material 'gone'"),
            std::string::npos);
  EXPECT_NE(
      of("quad.obj", R"({"reflectance_beyond": 0.1, "colours": [{"srgb": [1, 2, 3], "material": "half"}]})")
          .find("'reflectance_beyond' is for reflectances that are made of colours"),
      std::string::npos);
  write("quad.mtl", "newmtl paint\nmap_d -imfchan x tex.png\n");
  EXPECT_NE(
      of("quad.obj")
          .find(
              "quad.mtl:2:16: the channel 'x' of a picture is not read; expected 'r', 'g', 'b', 'm' or 'l'"),
      std::string::npos)
      << of("quad.obj");
  write("quad.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd tex.png\n");
  std::filesystem::remove(folder_ / "tex.png");
  EXPECT_NE(of("quad.obj").find("quad.mtl:3:8: there is no image '"), std::string::npos) << of("quad.obj");
}

}  // namespace
}  // namespace ifov::session::test_textured_meshes
