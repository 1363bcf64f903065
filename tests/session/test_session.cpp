#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/format.h"
#include "io/document/document.h"
#include "render/tolerance/accuracy_tolerance.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::test_session {
namespace {

class SessionTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_session_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  /// A document with one object (JSON text) of a document with a material "grey".
  io::Document document_with(const std::string& object, const std::string& more = "") const {
    return io::parse_document(
        format(
            "{{\"ifov\": 1,\n \"scene\": {{\"materials\": {{\"grey\": {{\"reflectance\": 0.3}}}},\n"
            "  \"objects\": [\n   {}]}},\n"
            " \"light\": {{\"sun\": {{\"point\": {{\"zenith\": \"30 deg\", \"azimuth\": \"90 deg\"}}}}}},\n"
            " \"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"1 m\", \"pixels\": [6, 4]}}}},\n"
            "  \"channels\": [{{\"name\": \"red\", \"monochromatic\": {{\"at\": \"0.65 um\"}}}}]}}{}}}",
            object, more),
        (folder_ / "scene.json").string());
  }

  std::string load_error(const std::string& object) const {
    try {
      session::Session::load(document_with(object), nullptr);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// Accuracy as a share of the noise that channels declare, as a radiance or as a temperature difference.
TEST_F(SessionTest, AccuracyInUnitsOfTheNoise) {
  const auto limits = [&](const std::string& noise) {
    const io::Document document = io::parse_document(
        format(
            R"({{"ifov": 1, "scene": {{"materials": {{"grey": {{"reflectance": 0.3, "temperature": "300 K"}}}},
          "objects": [{{"plane": {{}}, "material": "grey"}}]}},
          "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [2, 2]}}}},
            "channels": [{{"name": "hot", "gaussian": {{"center": "10 um", "fwhm": "0.5 um"}}{}}}]}},
          "sampling": {{"accuracy": {{"error": "0.5 noise"}}}}}})",
            noise),
        (folder_ / "noise.json").string());
    const session::Session session = session::Session::load(document, nullptr);
    std::vector<double> limit(1);
    session.parts().tolerance->limits(std::vector<double>{9.0}, limit);
    return limit[0];
  };
  EXPECT_NEAR(limits(R"(, "noise": "0.02 W m-2 sr-1 um-1")"), 0.01, 1e-12);
  // The slope of Planck's law at 10 um and 300 K is 0.1600 W m-2 sr-1 um-1 K-1.
  EXPECT_NEAR(limits(R"(, "noise_temperature": "0.1 K")"), 0.5 * 0.1 * 0.1600, 5e-5);
  try {
    limits("");
    FAIL() << "a channel without noise was taken";
  } catch (const InputError& error) {
    expect_in(
        "channel 'hot' has none above 0: give it 'noise', 'noise_temperature' or 'snr', or the sensor a 'detector'",
        error.what());
    expect_in("noise.json:4:", error.what());
  }
}

TEST_F(SessionTest, MissingMeshIsShownInTheDocument) {
  const std::string error = load_error(R"({"mesh": {"file": "none.obj"}, "material": "grey"})");
  expect_in("scene.json:4:", error);
  expect_in("none.obj", error);
  expect_in("^", error);
}

TEST_F(SessionTest, BrokenMeshNamesItsOwnLineToo) {
  write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const std::string error = load_error(R"({"mesh": {"file": "broken.obj"}, "material": "grey"})");
  expect_in("scene.json:4:", error);
  expect_in("broken.obj:4", error);
}

TEST_F(SessionTest, SlotWithoutMaterialListsTheSlots) {
  write("roof.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl tiles\nf 1 2 3\n");
  const std::string error =
      load_error(R"({"mesh": {"file": "roof.obj"}, "material": {"slots": {"walls": "grey"}}})");
  expect_in("no material for slot 'tiles' of the mesh; the slots given are 'walls'", error);
}

TEST_F(SessionTest, ClassWithoutMaterialNamesItsCell) {
  write("classes.asc", "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 7\n");
  const std::string error =
      load_error(R"({"plane": {}, "material": {"map": {"file": "classes.asc", "classes": {"1": "grey"}}}})");
  expect_in("class 7 at row 1, column 2", error);
  expect_in("the classes given are 1", error);
}

TEST_F(SessionTest, CoordinatesAreTakenOffTheMapOriginInDouble) {
  const auto render = [&](const std::string& origin, double east_m) {
    const io::Document document = io::parse_document(
        format(
            "{{\"ifov\": 1, \"scene\": {{{} \"materials\": {{\"grey\": {{\"reflectance\": 0.3}}, "
            "\"white\": {{\"reflectance\": 0.9}}}},\n\"objects\": [{{\"plane\": {{}}, \"material\": \"grey\"}}, "
            "{{\"box\": {{\"low\": [\"{} m\", \"0 m\", \"0 m\"], \"high\": [\"{} m\", \"1 m\", \"1 m\"]}}, "
            "\"material\": \"white\"}}]}},\n\"light\": {{\"sky\": {{\"radiance\": \"50 W m-2 sr-1 um-1\"}}}},\n"
            "\"sensor\": {{\"camera\": {{\"orthographic\": {{\"gsd\": \"0.37 m\", \"pixels\": [9, 9], \"center\": "
            "[\"{} m\", \"0 m\"]}}}}, \"channels\": [{{\"name\": \"red\", \"monochromatic\": {{\"at\": \"0.65 "
            "um\"}}}}]}}, \"sampling\": {{\"grid\": {{\"elements\": [3, 3]}}, \"max_depth\": 1}}}}",
            origin, east_m, east_m + 1.0, east_m),
        (folder_ / "far.json").string());
    session::RunOptions options;
    options.output_folder = folder_ / format("out_{}", east_m);
    session::Session::load(document, nullptr).render(options);
    std::ifstream file(options.output_folder / "image_abundance.img", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string near = render("", 0.0);
  EXPECT_FALSE(near.empty());
  EXPECT_EQ(near, render("\"origin\": {\"easting\": \"500000 m\", \"northing\": \"0 m\"},", 500000.0));
}

TEST_F(SessionTest, CancelledRunsLeaveNothingThatLooksComplete) {
  const session::Session session =
      session::Session::load(document_with(R"({"plane": {}, "material": "grey"})"), nullptr);
  CancelToken cancel;
  cancel.cancel();
  session::RunOptions options;
  options.output_folder = folder_ / "out";
  options.cancel = &cancel;
  EXPECT_THROW(session.render(options), Cancelled);
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out"))
    EXPECT_EQ(entry.path().extension(), ".part") << entry.path();
}

}  // namespace
}  // namespace ifov::test_session
