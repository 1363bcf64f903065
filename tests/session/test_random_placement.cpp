// Copies at random as they stand in a scene.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/format.h"
#include "geometry/world.h"
#include "io/document/document.h"
#include "session/loaded/parts.h"
#include "session/session.h"

namespace ifov::session::test_random_placement {
namespace {

class Messages final : public LogSink {
 public:
  void info(const std::string& message) override { text += message + "\n"; }
  void warn(const std::string& message) override { text += "warning: " + message + "\n"; }
  std::string text;
};

void expect_in(const std::string& part, const std::string& text) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

class RandomPlacementTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / format("ifov_scattered_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A grid of numbers in cells of 20 m, its lower left corner at (1000, 2000) m.
  void write_grid(const std::string& name, int columns, int rows, const std::string& numbers) const {
    std::ofstream(folder_ / name) << format(
        "ncols {}\nnrows {}\nxllcorner 1000\nyllcorner 2000\ncellsize 20\nNODATA_value -9999\n{}\n", columns,
        rows, numbers);
  }

  /// A scene about (1040, 2040, 100) m with these objects.
  Session load(const std::string& objects, const std::string& time = "") {
    log_.text.clear();
    return Session::load(io::parse_document(format(R"({{"ifov": 1, {}"scene": {{
 "origin": {{"easting": "1040 m", "northing": "2040 m", "height": "100 m"}},
 "materials": {{"soil": {{"reflectance": 0.2}}, "leaf": {{"reflectance": 0.5}}, "bark": {{"reflectance": 0.1}}}},
 "prototypes": {{
  "tree": [{{"sphere": {{"center": ["0 m", "0 m", "0 m"], "radius": "0.5 m"}}, "material": "leaf"}}],
  "post": [{{"sphere": {{"center": ["0 m", "0 m", "0 m"], "radius": "0.1 m"}}, "material": "bark"}}]}},
 "objects": [{}]}},
 "light": {{"sky": {{"radiance": "50 W m-2 sr-1 um-1"}}, "surroundings": {{"reflectance": 0.2}}}},
 "sensor": {{"camera": {{"orthographic": {{"gsd": "1 m", "pixels": [4, 4]}}}},
  "channels": [{{"name": "red", "monochromatic": {{"at": "0.65 um"}}}}]}}}})",
                                                   time, objects),
                                            (folder_ / "scene.json").string()),
                         &log_);
  }

  /// The copies behind `first` other objects.
  static std::vector<geometry::World::PlacedObject> copies(const Session& session, std::size_t first = 1) {
    const geometry::World& world = *session.parts().scene.world;
    std::vector<geometry::World::PlacedObject> list;
    for (std::size_t k = first; k < world.object_count(); ++k) list.push_back(world.object(k));
    return list;
  }

  std::filesystem::path folder_;
  Messages log_;
};

const std::string kArea = R"("area": {"low": ["1010 m", "2010 m"], "high": ["1070 m", "2070 m"]})";
// A plane that rises by 1 m in 4 m to the east: 100 m at 1010 m.
const std::string kSlope = "100 105 110 115\n100 105 110 115\n100 105 110 115\n100 105 110 115";
const std::string kGround = R"({"name": "ground", "terrain": {"file": "slope.asc"}, "material": "soil"})";

TEST_F(RandomPlacementTest, StandsOnATerrain) {
  write_grid("slope.asc", 4, 4, kSlope);
  const Session session = load(
      kGround + R"(, {"random_placement": {"of": "tree", "density": "0.05 m-2", "minimum_distance": "2 m",
    "on": "ground", "scale": [0.8, 1.2], )" +
      kArea + "}}");
  const auto trees = copies(session);
  EXPECT_NEAR(static_cast<double>(trees.size()), 180.0, 4.0 * std::sqrt(180.0));
  double smallest = 1e9, largest = 0.0, nearest = 1e9;
  for (const auto& tree : trees) {
    // About the scene's origin: height 100 m + (x + 30 m) / 4 less 100 m.
    EXPECT_NEAR(tree.centre_m.z, (tree.centre_m.x + 30.0) / 4.0, 1e-4);
    EXPECT_LE(std::max(std::abs(tree.centre_m.x), std::abs(tree.centre_m.y)), 30.0);
    smallest = std::min(smallest, tree.radius_m);
    largest = std::max(largest, tree.radius_m);
    for (const auto& other : trees)
      if (&other != &tree)
        nearest = std::min(
            nearest, std::hypot(other.centre_m.x - tree.centre_m.x, other.centre_m.y - tree.centre_m.y));
  }
  EXPECT_GE(nearest, 2.0 - 1e-9);
  EXPECT_GT(smallest, 0.4 - 1e-9);
  EXPECT_LT(smallest, 0.43);
  EXPECT_GT(largest, 0.57);
  EXPECT_LT(largest, 0.6 + 1e-9);
  expect_in(format("random placement of 'tree': {} copies, {:.4g} ha-1 (asked for: 500 ha-1)", trees.size(),
                   static_cast<double>(trees.size()) / 0.36),
            log_.text);
  EXPECT_EQ(log_.text.find("warning: random placement"), std::string::npos) << log_.text;
}

TEST_F(RandomPlacementTest, StandsOnWhatIsThereNow) {
  const auto lawn = [](const char* height_m, const char* from, const char* to) {
    return format(
        R"({{"name": "lawn", "plane": {{"height": "{} m"}}, "material": "soil", "present": [["{}", "{}"]]}},)",
        height_m, from, to);
  };
  const std::string stands =
      R"({"random_placement": {"of": "tree", "density": "0.05 m-2", "on": "lawn", )" + kArea + "}}";
  const std::string before = lawn("108", "2026-05-21T00:00Z", "2026-06-21T00:00Z"),
                    now = lawn("103", "2026-06-21T00:00Z", "2026-07-21T00:00Z");
  for (const auto& [objects, height_m] : {std::pair{before + now, 3.0}, {now + before, 3.0}, {before, 8.0}}) {
    const Session session = load(objects + stands, R"("time": "2026-06-21T15:00:00Z", )");
    const std::size_t grounds = height_m == 3.0 ? 1 : 0;
    ASSERT_GT(copies(session, grounds).size(), 100u);
    for (const auto& tree : copies(session, grounds)) EXPECT_NEAR(tree.centre_m.z, height_m, 1e-6);
  }
}

TEST_F(RandomPlacementTest, LeavesOutPlacesWithoutGround) {
  write_grid("slope.asc", 4, 4,
             "100 100 -9999 -9999\n100 100 -9999 -9999\n100 100 -9999 -9999\n100 100 -9999 -9999");
  const Session session =
      load(kGround + R"(, {"random_placement": {"of": "tree", "density": "0.05 m-2", "on": "ground", )" +
           kArea + "}}");
  const auto trees = copies(session);
  EXPECT_GT(trees.size(), 20u);
  for (const auto& tree : trees) EXPECT_LT(tree.centre_m.x, -9.9);
  expect_in("places have nothing of 'ground' under them and stay empty", log_.text);
}

TEST_F(RandomPlacementTest, StandsOnAPlaneOrAtAHeight) {
  const Session plane =
      load(R"({"name": "lawn", "plane": {"height": "103 m"}, "material": "soil"}, {"random_placement":
    {"of": "tree", "density": "0.05 m-2", "on": "lawn", )" +
           kArea + "}}");
  ASSERT_GT(copies(plane).size(), 100u);
  for (const auto& tree : copies(plane)) EXPECT_NEAR(tree.centre_m.z, 3.0, 1e-6);
  const Session height = load(R"({"plane": {"height": "103 m"}, "material": "soil"}, {"random_placement":
    {"of": "tree", "density": "0.05 m-2", "height": "102 m", )" +
                              kArea + "}}");
  ASSERT_EQ(copies(height).size(), copies(plane).size());
  for (std::size_t k = 0; k < copies(plane).size(); ++k) {
    EXPECT_EQ(copies(height)[k].centre_m.x, copies(plane)[k].centre_m.x);
    EXPECT_NEAR(copies(height)[k].centre_m.z, 2.0, 1e-9);
  }
}

TEST_F(RandomPlacementTest, FollowsADensityMap) {
  // From the north: nothing, then 1 (a density of 0.1 m-2), a cell without a number, 0.25.
  write_grid("cover.asc", 2, 2, "0 1\n-9999 0.25");
  const Session session = load(R"({"plane": {"height": "100 m"}, "material": "soil"}, {"random_placement":
    {"of": "tree", "density": {"file": "cover.asc", "unit": "0.1 m-2"},
     "area": {"low": ["1000 m", "2000 m"], "high": ["1040 m", "2040 m"]}}})");
  double north_east = 0.0, south_east = 0.0;
  for (const auto& tree : copies(session)) {
    EXPECT_GT(tree.centre_m.x, -20.0);
    (tree.centre_m.y > -20.0 ? north_east : south_east) += 1.0;
  }
  EXPECT_NEAR(north_east, 40.0, 4.0 * std::sqrt(40.0));
  EXPECT_NEAR(south_east, 10.0, 4.0 * std::sqrt(10.0));
  expect_in("(asked for: 312.5 ha-1)", log_.text);

  write_grid("cover.asc", 2, 2, "0 1\n-3 0.25");
  try {
    load(
        R"({"plane": {}, "material": "soil"}, {"random_placement": {"of": "tree", "density": {"file": "cover.asc"}, )" +
        kArea + "}}");
    FAIL();
  } catch (const InputError& error) {
    expect_in("scene.json", error.what());
    expect_in("cover.asc' holds -3 at row 2, column 1: densities are 0 or more", error.what());
  }
}

TEST_F(RandomPlacementTest, SaysWhereDistanceAndDensityContradict) {
  const Session session = load(R"({"plane": {"height": "100 m"}, "material": "soil"}, {"random_placement":
    {"of": "tree", "density": "900 ha-1", "minimum_distance": "4 m", )" +
                               kArea + "}}");
  expect_in(
      "warning: random placement of 'tree': at a distance of 4 m at least, 391.8 ha-1 stand, not 900 ha-1 as asked "
      "for on 100 % of "
      "the area; lower 'density' or 'minimum_distance'",
      log_.text);
  EXPECT_NEAR(static_cast<double>(copies(session).size()), 141.0, 12.0);
}

TEST_F(RandomPlacementTest, MixesPrototypesByWeight) {
  const Session session = load(R"({"plane": {"height": "100 m"}, "material": "soil"}, {"random_placement":
    {"of": [{"prototype": "tree", "weight": 3}, {"prototype": "post"}], "density": "0.2 m-2", )" +
                               kArea + "}}");
  double trees = 0.0, posts = 0.0;
  for (const auto& copy : copies(session)) (copy.radius_m > 0.3 ? trees : posts) += 1.0;
  const double all = trees + posts;
  EXPECT_NEAR(all, 720.0, 4.0 * std::sqrt(720.0));
  EXPECT_NEAR(trees / all, 0.75, 4.0 * std::sqrt(0.75 * 0.25 / all));
}

TEST_F(RandomPlacementTest, FormerNameIsReadAndWarnedOf) {
  const Session now = load(R"({"plane": {"height": "100 m"}, "material": "soil"}, {"random_placement":
    {"of": "tree", "density": "0.05 m-2", )" +
                           kArea + "}}");
  EXPECT_EQ(log_.text.find("former"), std::string::npos) << log_.text;
  const Session before = load(R"({"plane": {"height": "100 m"}, "material": "soil"}, {"scatter":
    {"of": "tree", "density": "0.05 m-2", )" +
                              kArea + "}}");
  expect_in("'scatter' is called 'random_placement' now; its former name is read in this version only",
            log_.text);
}

}  // namespace
}  // namespace ifov::session::test_random_placement
