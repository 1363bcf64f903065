// A document that is written reads back as the same; tests/io_document/test_written_documents.py does so with all that there are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "document_maker.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/schema/record.h"
#include "io/json/json_writer.h"

namespace ifov::io::test_document_text {
namespace {

using test::kDocument;

std::string again(const std::string& text, const DocumentText& how = {}) {
  return document_text(parse_document(text, "folder/a.json"), "folder/a.json", how);
}

TEST(DocumentText, IsReadAsTheSame) {
  const std::string text = again(kDocument);
  EXPECT_EQ(again(text), text);
  const std::string all = again(kDocument, {.all_keys = true});
  EXPECT_EQ(again(all), text);
  EXPECT_EQ(again(all, {.all_keys = true}), all);
  EXPECT_GT(all.size(), text.size());
}

TEST(DocumentText, SaysWhatDiffersFromTheDefaultsOnShortLines) {
  const std::string text = again(R"({"ifov": 1, "seed": 1,
    "scene": {"materials": {"soil": {"reflectance": 0.25, "scattering": "lambertian"}},
      "objects": [{"cylinder": {"base": ["0 cm", "100 cm", "0.5 m"], "radius": "12.5 cm", "height": "3 m"}, "material": "soil"}]},
    "light": {"sun": {"disc": {"zenith": "30 deg", "azimuth": "180 deg", "diameter": "0.53 deg"}}},
    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 2], "view_zenith": "0 deg"}},
      "channels": [{"gaussian": {"center": "550 nm", "fwhm": "10 nm"}}]},
    "sampling": {"accuracy": {"error": "0.5 K"}}})");
  EXPECT_EQ(text, R"({
  "ifov": 1,
  "scene": {
    "materials": {"soil": {"reflectance": 0.25}},
    "objects": [
      {
        "cylinder": {"base": ["0 m", "1 m", "0.5 m"], "radius": "0.125 m", "height": "3 m"},
        "material": "soil"
      }
    ]
  },
  "light": {"sun": {"disc": {"zenith": "30 deg", "azimuth": "180 deg"}}},
  "sensor": {
    "camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 2]}},
    "channels": [{"gaussian": {"center": "0.55 um", "fwhm": "10 nm"}}]
  },
  "sampling": {"accuracy": {"error": "0.5 K"}}
}
)");
}

TEST(DocumentText, TellsOfSurroundingsWhatNamesThem) {
  for (const char* around :
       {R"("surroundings": {"material": "soil", "temperature": "290 K"})",
        R"("surroundings": {"reflectance": 0.3})", R"("surroundings": {"emissivity": 0.9})"}) {
    const std::string text =
        std::string(
            R"({"ifov": 1, "scene": {"materials": {"soil": {"reflectance": 0.25}}, "objects": [{"plane": {}, "material": "soil"}]},
      "light": {)") +
        around +
        R"(}, "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 2]}}, "channels": [{"gaussian": {"center": "0.5 um", "fwhm": "10 nm"}}]}})";
    EXPECT_NE(again(text).find(around), std::string::npos) << again(text);
  }
}

TEST(DocumentText, TellsTheReflectanceThatAModelDoesWithout) {
  const auto with = [](const char* material) {
    return std::string(R"({"ifov": 1, "scene": {"materials": {"pane": )") + material +
           R"(}, "objects": [{"plane": {}, "material": "pane"}]},
      "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [4, 2]}}, "channels": [{"gaussian": {"center": "0.5 um", "fwhm": "10 nm"}}]}})";
  };
  const std::string slab = R"("scattering": {"slab": {"n": 1.5, "k": 0, "thickness": "4 mm"}})";
  const std::string bare = again(with(("{" + slab + "}").c_str()));
  EXPECT_NE(bare.find(R"("reflectance": 1,)"), std::string::npos) << bare;
  EXPECT_EQ(again(with((R"({"reflectance": 1, )" + slab + "}").c_str())), bare);
  EXPECT_EQ(again(bare), bare);
  // White paint is told, too.
  EXPECT_NE(again(with(R"({"reflectance": 1})")).find(R"("reflectance": 1)"), std::string::npos);
  EXPECT_THROW(again(with(R"({"scattering": "mirror"})")), InputError);
}

TEST(DocumentText, NamesFilesFromItsOwnFolder) {
  Document document = parse_document(kDocument, "folder/a.json");
  EXPECT_NE(document_text(document, "folder/b.json").find(R"("leaf.csv")"), std::string::npos);
  EXPECT_NE(document_text(document, "other/b.json").find(R"("../folder/leaf.csv")"), std::string::npos);
  EXPECT_NE(document_text(document, "b.json").find(R"("folder/leaf.csv")"), std::string::npos);
}

TEST(DocumentText, CanBeAPartThatIncludesOthers) {
  const Document document = parse_document(kDocument, "a.json");
  const std::string text = document_text(
      document, "a.json", {.comment = "One.\nTwo.", .include = {"b.json"}, .sections = {"sampling"}});
  EXPECT_TRUE(text.starts_with("// One.\n// Two.\n{\n")) << text;
  EXPECT_NE(text.find(R"("include": "b.json")"), std::string::npos);
  EXPECT_EQ(text.find("scene"), std::string::npos);
}

TEST(DocumentText, SaysWhatCannotBeWritten) {
  const auto message = [](const Document& document) -> std::string {
    try {
      return document_text(document, "a.json");
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message({}),
            "the document cannot be written as 'a.json': 'scene.objects' is missing or cannot be told");
  Document document = parse_document(kDocument, "a.json");
  document.sensor.fill_factor = std::nan("");
  EXPECT_EQ(message(document),
            "the document cannot be written as 'a.json': 'sensor.fill_factor' is missing or cannot be told");
  document = parse_document(kDocument, "a.json");
  document.sensor.camera.settings = nullptr;
  EXPECT_NE(message(document).find("'sensor.'camera', 'distant'"), std::string::npos) << message(document);
}

TEST(QuantityText, IsShortAndExact) {
  const auto text = [](double value, const Dimension& dimension, double factor = 1.0) {
    return quantity_text(value, dimension, {}, factor).value_or("none");
  };
  EXPECT_EQ(text(30.0 * std::numbers::pi / 180.0, kAngle), "30 deg");
  EXPECT_EQ(text(0.5, kAngle), "0.5 rad");
  EXPECT_EQ(text(293.15, kTemperature), "20 degC");
  EXPECT_EQ(text(300.0, kTemperature), "300 K");
  EXPECT_EQ(text(45.0 * 1e-6, kLength), "45 um");
  EXPECT_EQ(text(0.05, kLength), "5 cm");
  EXPECT_EQ(text(4712345.5, kLength), "4712345.5 m");
  EXPECT_EQ(text(0.0, kLength), "0 m");
  EXPECT_EQ(text(300.0 * 1e-4, kDensity), "300 ha-1");
  EXPECT_EQ(text(23.0, kLength, 1e-3), "23 km");
  EXPECT_EQ(text(std::nan(""), kLength), "none");
  EXPECT_FALSE(quantity_text(-1.0, kLength, Range::above(0.0, "m")));
  // 360 degrees in radians are a little more than 360 degrees, read as radians.
  EXPECT_EQ(quantity_text(2.0 * std::numbers::pi, kAngle, Range::between(-360.0, 360.0, "deg")), "360 deg");
  // Any number at all.
  std::uint64_t state = 1;
  for (int k = 0; k < 2000; ++k) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const double value = std::ldexp(static_cast<double>(state >> 11), -45 - static_cast<int>(state % 16));
    for (const Dimension* dimension : {&kLength, &kAngle, &kWavelength, &kTemperature}) {
      const auto written = quantity_text(value, *dimension, {});
      if (!written) {  // nearer to zero or further away than such a quantity is
        EXPECT_TRUE(value < dimension->smallest || value > dimension->largest) << value;
        continue;
      }
      const auto parts = split_quantity(*written);
      const Unit* unit = dimension->find(parts->unit);
      EXPECT_EQ(parts->number * unit->factor + unit->offset, value) << *written;
    }
  }
}

/// A table as the sections have them, of two numbers; `lies`: one row gives another's value.
struct Pair {
  double a = 0.0, b = 1.0;
};
SchemaType<Pair> pair_type(bool lies) {
  Record<Pair> record("pair", "Two numbers.");
  record.required("a", &Pair::a, number(), "one")
      .with_default(
          "b", via([](Pair& p, double v) { p.b = v; }, [lies](const Pair& p) { return lies ? p.a : p.b; }),
          number(), "1", "another");
  return record.type();
}

TEST(Record, WritesWhatItReads) {
  const auto text = [](const SchemaType<Pair>& kind, const Pair& pair, bool all = false) {
    Writing writing{.folder = "", .all_keys = all};
    return kind.write(pair, writing)->on_one_line(100).value();
  };
  EXPECT_EQ(text(pair_type(false), {2.0, 1.0}), R"({"a": 2})");
  EXPECT_EQ(text(pair_type(false), {2.0, 1.0}, true), R"({"a": 2, "b": 1})");
  EXPECT_EQ(text(pair_type(false), {2.0, 3.0}), R"({"a": 2, "b": 3})");
  EXPECT_EQ(text(pair_type(true), {2.0, 3.0}), R"({"a": 2, "b": 2})");
}

}  // namespace
}  // namespace ifov::io::test_document_text
