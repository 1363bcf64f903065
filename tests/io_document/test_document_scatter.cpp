// Copies at random in a document, and what is wrong with one.
#include <gtest/gtest.h>

#include <string>

#include "document_maker.h"

namespace ifov::io::test_document_scatter {
namespace {

const std::string kInstances = R"({"instances": {"of": "tree", "at": [["1 m", "1 m", "0 m"]]}})";
const std::string kArea = R"("area": {"low": ["-10 m", "-20 m"], "high": ["30 m", "1 km"]})";

Document scattered(const std::string& keys) {
  return test::parsed_with(kInstances, R"({"random_placement": {)" + keys + "}}");
}

/// The message without the excerpt.
std::string message(const std::string& keys, const std::string& beside = "") {
  const std::string all =
      test::message_with(kInstances, R"({"random_placement": {)" + keys + "}" + beside + "}");
  return all.substr(0, all.find('\n'));
}

TEST(DocumentRandomPlacement, IsRead) {
  const Document document = scattered(R"("of": "tree", "density": "250 ha-1", )" + kArea);
  const auto& plain = std::get<RandomPlacement>(document.scene.objects.at(2).shape);
  ASSERT_EQ(plain.of.size(), 1u);
  EXPECT_EQ(plain.of[0].prototype.name, "tree");
  EXPECT_DOUBLE_EQ(std::get<double>(plain.density_m2), 0.025);
  EXPECT_EQ(plain.low_m, (std::array<double, 2>{-10.0, -20.0}));
  EXPECT_EQ(plain.high_m, (std::array<double, 2>{30.0, 1000.0}));
  EXPECT_EQ(plain.minimum_distance_m, 0.0);
  EXPECT_FALSE(plain.on);
  EXPECT_EQ(plain.scale, (std::array<double, 2>{1.0, 1.0}));
  EXPECT_TRUE(plain.turn);
  EXPECT_EQ(plain.seed, 0u);

  const Document full_document = scattered(
      R"("of": [{"prototype": "tree", "weight": 3}, {"prototype": "tree"}], "density": {"file": "cover.tif", "band": 2,
      "unit": "0.2 per m2"}, "minimum_distance": "3 m", "on": "ball", "scale": [0.8, 1.2], "turn": false, "seed": 9, )" +
      kArea);
  const auto& full = std::get<RandomPlacement>(full_document.scene.objects.at(2).shape);
  ASSERT_EQ(full.of.size(), 2u);
  EXPECT_EQ(full.of[0].weight, 3.0);
  EXPECT_EQ(full.of[1].weight, 1.0);
  const DensityMap& map = std::get<DensityMap>(full.density_m2);
  EXPECT_EQ(map.raster.file.path, "folder/cover.tif");
  EXPECT_EQ(map.band, 2);
  EXPECT_EQ(map.density_of_one_m2, 0.2);
  EXPECT_EQ(full.minimum_distance_m, 3.0);
  EXPECT_EQ(full.on->name, "ball");
  EXPECT_EQ(full.scale, (std::array<double, 2>{0.8, 1.2}));
  EXPECT_FALSE(full.turn);
  EXPECT_EQ(full.seed, 9u);
}

TEST(DocumentRandomPlacement, UnitsOfDensityAreOneAnother) {
  for (const std::string text :
       {"0.02 m-2", "0.02 per m2", "0.02 /m2", "200 ha-1", "200 per ha", "20000 km-2"}) {
    const Document document = scattered(R"("of": "tree", "density": ")" + text + "\", " + kArea);
    EXPECT_NEAR(std::get<double>(std::get<RandomPlacement>(document.scene.objects.at(2).shape).density_m2),
                0.02, 1e-15)
        << text;
  }
}

TEST(DocumentRandomPlacement, Messages) {
  const std::string tree = R"("of": "tree", )", density = R"("density": "1 m-2", )";
  EXPECT_EQ(
      message(tree + R"("density": "3", )" + kArea),
      "folder/a.json:25:54: 'scene.objects[2].random_placement.density' is the text \"3\" without a unit, expected a "
      "density above 0 m-2, such as \"300 ha-1\" (units: m-2, ha-1, km-2)");
  EXPECT_EQ(
      message(tree + R"("density": "3 per acre", )" + kArea),
      "folder/a.json:25:54: 'scene.objects[2].random_placement.density' is the text \"3 per acre\": 'per acre' "
      "is not a "
      "unit of density. Units: m-2, ha-1, km-2");
  EXPECT_EQ(
      message(tree + density + R"("area": {"low": ["0 m", "0 m"], "high": ["0 m", "5 m"]})"),
      "folder/a.json:25:103: 'scene.objects[2].random_placement.area.high' is not above 'low' in both coordinates");
  EXPECT_EQ(
      message(tree + density + R"("scale": [2, 1], )" + kArea),
      "folder/a.json:25:72: 'scene.objects[2].random_placement.scale' falls: the smaller factor comes first");
  EXPECT_EQ(message(R"("of": "oak", )" + density + kArea),
            "folder/a.json:25:35: there is no prototype 'oak' (declared: 'tree')");
  EXPECT_EQ(message(R"("of": [{"prototype": "tree"}, {"prototype": "tre"}], )" + density + kArea),
            "folder/a.json:25:73: there is no prototype 'tre'; did you mean 'tree'? (declared: 'tree')");
  EXPECT_EQ(message(tree + density + R"("on": "bal", )" + kArea),
            "folder/a.json:25:69: there is no object with a shape of its own 'bal'; did you mean 'ball'? "
            "(declared: "
            "'ball')");
  EXPECT_EQ(message(tree + R"("density": {"file": "a.tif", "by": "texture coordinates"}, )" + kArea),
            "folder/a.json:25:72: a density map lies by place");
}

TEST(DocumentRandomPlacement, WrongKeysAreNamed) {
  const std::string tree = R"("of": "tree", "density": "1 m-2", )";
  const auto expect_in = [](const std::string& part, const std::string& text) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect_in("did you mean 'minimum_distance'?", message(tree + R"("min_distance": "1 m", )" + kArea));
  expect_in("'area'", message(R"("of": "tree", "density": "1 m-2")"));
  expect_in("'density'", message(R"("of": "tree", )" + kArea));
  expect_in("'on'", message(tree + R"("on": "ball", "height": "1 m", )" + kArea));
  expect_in("'transform'", message(tree + kArea, R"(, "transform": {"scale": 2})"));
  expect_in("'material'", message(tree + kArea, R"(, "material": "leaf")"));
}

TEST(DocumentRandomPlacement, IsReadUnderItsFormerName) {
  const std::string keys = R"({"of": "tree", "density": "250 ha-1", )" + kArea;
  const Document document = test::parsed_with(kInstances, R"({"scatter": )" + keys + R"(}, "seed": false})");
  const auto& scatter = std::get<RandomPlacement>(document.scene.objects.at(2).shape);
  EXPECT_DOUBLE_EQ(std::get<double>(scatter.density_m2), 0.025);
  EXPECT_EQ(document.scene.objects.at(2).pilot_ray, false);
  ASSERT_EQ(document.former_keys.size(), 2u);
  EXPECT_EQ(document.former_keys[0].former, "scatter");
  EXPECT_EQ(document.former_keys[0].name, "random_placement");
  EXPECT_EQ(document.former_keys[0].position.line, 25);
  EXPECT_EQ(document.former_keys[0].position.column, 8);
  EXPECT_EQ(document.former_keys[1].name, "pilot_ray");
  // The text is kept as it was written, and so are paths in messages.
  EXPECT_NE(document.text->find(R"("scatter":)"), std::string::npos);
  const auto error = [&](const std::string& object) {
    const std::string all = test::message_with(kInstances, object);
    return all.substr(0, all.find('\n'));
  };
  EXPECT_EQ(error(R"({"scatter": )" + keys + R"(, "scale": [2, 1]}})").substr(0, 70),
            "folder/a.json:25:129: 'scene.objects[2].scatter.scale' falls: the smal");
  EXPECT_EQ(error(R"({"scatter": )" + keys + R"(}, "seed": false, "pilot_ray": true})"),
            "folder/a.json:25:121: 'seed' is the former name of 'pilot_ray', which is there too");
  EXPECT_EQ(error(R"({"scatter": )" + keys + R"(}, "instances": {"of": "tree"}})"),
            "folder/a.json:25:121: 'instances' cannot stand beside 'scatter' in 'scene.objects[2]'");
  EXPECT_TRUE(test::parsed_with(kInstances, R"({"random_placement": )" + keys + "}}").former_keys.empty());
}

TEST(DocumentRandomPlacement, StandsInTheSceneOnly) {
  const std::string text = test::message_with(
      R"("tree": [{)",
      R"("wood": [{"random_placement": {"of": "tree", "density": "1 m-2", )" + kArea + R"(}}], "tree": [{)");
  EXPECT_NE(text.find("a prototype cannot hold a random placement"), std::string::npos) << text;
}

}  // namespace
}  // namespace ifov::io::test_document_scatter
