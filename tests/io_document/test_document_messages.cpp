// Error messages, word for word: they are what the user reads.
#include <gtest/gtest.h>

#include "document_maker.h"

namespace ifov::io::test_document_messages {
namespace {

using test::document_with;
using test::message_with;

/// Without the excerpt.
std::string first_line_with(const std::string& from, const std::string& to) {
  const std::string message = message_with(from, to);
  return message.substr(0, message.find('\n'));
}

const std::string kRadius = "\"radius\": \"50 cm\"";

/// The message that a radius leads to, which stands in line 21.
std::string radius_message(const std::string& what, const std::string& value) {
  return "folder/a.json:21:21: 'scene.objects[1].sphere.radius' is " + what +
         "\n   21 |           \"radius\": " + value + "\n      |                     ^";
}

TEST(DocumentMessages, Quantities) {
  const std::string expected =
      "expected a length above 0 m, such as \"1 m\" (units: m, km, cm, mm, um, nm, ft, in)";
  EXPECT_EQ(message_with(kRadius, "\"radius\": 0.5"),
            radius_message("the number 0.5 without a unit, " + expected, "0.5"));
  EXPECT_EQ(message_with(kRadius, "\"radius\": \"0.5\""),
            radius_message("the text \"0.5\" without a unit, " + expected, "\"0.5\""));
  EXPECT_EQ(message_with(kRadius, "\"radius\": \"-1 m\""),
            radius_message("the text \"-1 m\", " + expected, "\"-1 m\""));
  EXPECT_EQ(message_with(kRadius, "\"radius\": \"0 m\""),
            radius_message("the text \"0 m\", " + expected, "\"0 m\""));
  EXPECT_EQ(message_with(kRadius, "\"radius\": \"wide\""),
            radius_message("the text \"wide\", " + expected, "\"wide\""));
  EXPECT_EQ(message_with(kRadius, "\"radius\": null"), radius_message("null, " + expected, "null"));
  EXPECT_EQ(message_with(kRadius, "\"radius\": true"), radius_message("true, " + expected, "true"));
  EXPECT_EQ(message_with(kRadius, "\"radius\": [1, 2]"),
            radius_message("a list of 2, " + expected, "[1, 2]"));
  EXPECT_EQ(message_with(kRadius, "\"radius\": {}"), radius_message("an empty object, " + expected, "{}"));
}

TEST(DocumentMessages, Units) {
  EXPECT_EQ(
      message_with(kRadius, "\"radius\": \"1 parsec\""),
      radius_message(
          "the text \"1 parsec\": 'parsec' is not a unit of length. Units: m, km, cm, mm, um, nm, ft, in",
          "\"1 parsec\""));
  EXPECT_EQ(
      message_with("\"20 degC\"", "\"20 dgC\""),
      "folder/a.json:9:52: 'scene.materials.soil.temperature' is the text \"20 dgC\": 'dgC' is not a unit of "
      "temperature; did you mean 'degC'? Units: K, degC, degF\n"
      "    9 |       \"soil\": {\"reflectance\": 0.25, \"temperature\": \"20 dgC\"},\n"
      "      |                                                    ^");
  EXPECT_EQ(message_with("\"-10 degC\"", "\"-300 degC\""),
            "folder/a.json:30:28: 'light.sky.temperature' is the text \"-300 degC\", expected a temperature "
            "of at least "
            "0 K, such as \"20 degC\" (units: K, degC, degF)\n"
            "   30 |     \"sky\": {\"temperature\": \"-300 degC\"}\n"
            "      |                            ^");
  EXPECT_EQ(message_with("\"43 deg\"", "\"93 deg\""),
            "folder/a.json:7:28: 'scene.origin.latitude' is the text \"93 deg\", expected an angle between "
            "-90 and 90 deg, "
            "such as \"30 deg\" (units: deg, rad, mrad)\n"
            "    7 |     \"origin\": {\"latitude\": \"93 deg\", \"longitude\": \"-77 deg\"},\n"
            "      |                            ^");
  EXPECT_EQ(
      message_with("\"0.1 K\"", "\"0.1 degC\""),
      "folder/a.json:41:38: 'sampling.accuracy.error' is the text \"0.1 degC\", expected a size above "
      "0 with its "
      "unit, such as \"0.1 K\", \"1 %\", \"12 W m-2 sr-1 um-1\", \"0.002 reflectance\", \"0.5 noise\", \"0.5 % DoLP\" (units: K, mK, "
      "%, W m-2 sr-1 "
      "um-1, W m-2 sr-1 nm-1, mW m-2 sr-1 nm-1, uW cm-2 sr-1 nm-1, reflectance, noise, % DoLP)\n"
      "   41 |   \"sampling\": {\"accuracy\": {\"error\": \"0.1 degC\", \"channel\": \"8.5 um\"}},\n"
      "      |                                      ^");
}

TEST(DocumentMessages, UnknownKeys) {
  EXPECT_EQ(
      message_with("\"seed\": 7", "\"sead\": 7"),
      "folder/a.json:4:3: unknown key 'sead' in the document; did you mean 'seed'? Known keys: 'ifov', "
      "'$schema', "
      "'include', 'seed', 'time', 'scene', 'light', 'atmosphere', 'weather', 'temperatures', 'platform', 'sensor', 'instruments', 'instrument', 'sampling' and 'output'\n"
      "    4 |   \"sead\": 7,\n"
      "      |   ^");
  EXPECT_EQ(
      message_with("\"fwhm\": \"0.02 um\"", "\"width\": \"0.02 um\""),
      "folder/a.json:35:56: unknown key 'width' in 'sensor.channels[0].gaussian'. Known keys: 'center' and "
      "'fwhm'\n"
      "   35 |       {\"name\": \"red\", \"gaussian\": {\"center\": \"650 nm\", \"width\": \"0.02 um\"}},\n"
      "      |                                                        ^");
  EXPECT_EQ(message_with("\"csv\": \"leaf.csv\"", "\"cvs\": \"leaf.csv\""),
            "folder/a.json:10:31: unknown key 'cvs' in 'scene.materials.leaf.emissivity'; did you mean "
            "'csv'? Known keys: "
            "'csv', 'wavelength_unit', 'column', 'scale', 'range', 'outside', 'table', 'ecostress', 'usgs', "
            "'wavelengths', 'asd', 'sli', 'spectrum', 'ems', 'curve', 'join' and 'library'\n"
            "   10 |       \"leaf\": {\"emissivity\": {\"cvs\": \"leaf.csv\", \"wavelength_unit\": \"nm\", "
            "\"scale\": 0.01}}\n"
            "      |                               ^");
}

TEST(DocumentMessages, MissingKeys) {
  EXPECT_EQ(first_line_with(kRadius, "\"center\": 1"),
            "folder/a.json:21:11: the key 'center' is given twice");
  EXPECT_EQ(message_with(",\n          " + kRadius, ""),
            "folder/a.json:19:19: 'scene.objects[1].sphere' lacks the key 'radius': a length above 0 m, such "
            "as \"1 m\" "
            "(units: m, km, cm, mm, um, nm, ft, in)\n"
            "   19 |         \"sphere\": {\n"
            "      |                   ^");
  EXPECT_EQ(
      message_with("\"plane\": {}, ", ""),
      "folder/a.json:16:7: 'scene.objects[0]' needs exactly one of 'plane', 'box', 'sphere', 'hemisphere', "
      "'cylinder', 'disk', 'polygon', 'mesh', 'city' or 'terrain'\n"
      "   16 |       {\"material\": \"soil\"},\n"
      "      |       ^");
  EXPECT_EQ(message_with(", \"azimuth\": \"180 deg\"", ""),
            "folder/a.json:29:21: 'zenith' needs the key 'azimuth' beside it in 'light.sun.disc'\n"
            "   29 |     \"sun\": {\"disc\": {\"zenith\": \"30 deg\"}},\n"
            "      |                     ^");
  EXPECT_EQ(message_with("\"csv\": \"leaf.csv\", ", ""),
            "folder/a.json:10:30: 'scene.materials.leaf.emissivity' needs exactly one of 'csv', 'table', "
            "'ecostress', 'usgs', 'asd', 'sli', 'ems', 'join' or 'library'\n"
            "   10 |       \"leaf\": {\"emissivity\": {\"wavelength_unit\": \"nm\", \"scale\": 0.01}}\n"
            "      |                              ^");
}

TEST(DocumentMessages, KeysThatExcludeEachOther) {
  EXPECT_EQ(message_with("{\"plane\": {}", "{\"plane\": {}, \"box\": {}"),
            "folder/a.json:16:21: 'box' cannot stand beside 'plane': 'scene.objects[0]' takes only one of "
            "'plane', 'box', "
            "'sphere', 'hemisphere', 'cylinder', 'disk', 'polygon', 'mesh', 'city' or 'terrain'\n"
            "   16 |       {\"plane\": {}, \"box\": {}, \"material\": \"soil\"},\n"
            "      |                     ^");
  EXPECT_EQ(message_with("\"sampling\": {", "\"sampling\": {\"single\": {}, "),
            "folder/a.json:41:30: 'accuracy' cannot stand beside 'single': 'sampling' takes only one of "
            "'single', 'grid', "
            "'adaptive' or 'accuracy'\n"
            "   41 |   \"sampling\": {\"single\": {}, \"accuracy\": {\"error\": \"0.1 K\", \"channel\": "
            "\"8.5 um\"}},\n"
            "      |                              ^");
}

TEST(DocumentMessages, WrongTypesCountsAndWords) {
  EXPECT_EQ(message_with("[30, 20]", "[30]"),
            "folder/a.json:33:57: 'sensor.camera.orthographic.pixels' is a list of 1, expected a list of 2, "
            "each an "
            "integer between 1 and 100000\n"
            "   33 |     \"camera\": {\"orthographic\": {\"gsd\": \"1 m\", \"pixels\": [30]}},\n"
            "      |                                                         ^");
  EXPECT_EQ(message_with("[30, 20]", "[30, 20.5]"),
            "folder/a.json:33:62: 'sensor.camera.orthographic.pixels[1]' is the number 20.5, expected an "
            "integer between 1 "
            "and 100000\n"
            "   33 |     \"camera\": {\"orthographic\": {\"gsd\": \"1 m\", \"pixels\": [30, 20.5]}},\n"
            "      |                                                              ^");
  EXPECT_EQ(
      message_with("\"sampling\": {", "\"sampling\": {\"mirror_reflections\": 9, "),
      "folder/a.json:41:38: 'sampling.mirror_reflections' is the number 9, expected an integer between 0 and 8\n"
      "   41 |   \"sampling\": {\"mirror_reflections\": 9, \"accuracy\": {\"error\": \"0.1 K\", \"channel\": "
      "\"8.5 um\"}},\n"
      "      |                                      ^");
  EXPECT_EQ(message_with("\"reflectance\": 0.25", "\"reflectance\": \"25 %\""),
            "folder/a.json:9:31: 'scene.materials.soil.reflectance' is the text \"25 %\", expected a number "
            "between 0 and 1, "
            "or an object, or a list of 2 to 100000, each a number between 0 and 1, or an object\n"
            "    9 |       \"soil\": {\"reflectance\": \"25 %\", \"temperature\": \"20 degC\"},\n"
            "      |                               ^");
  EXPECT_EQ(
      message_with("\"output\": {", "\"output\": {\"formats\": [\"tiff\"], "),
      "folder/a.json:42:26: 'output.formats[0]' is the text \"tiff\", expected 'envi', 'geotiff', 'netcdf', "
      "'glt', 'vrt', 'demosaiced', 'png', 'html' or 'stac'\n"
      "   42 |   \"output\": {\"formats\": [\"tiff\"], \"folder\": \"products\", \"quicklook\": "
      "{\"channels\": [\"red\"]}}\n"
      "      |                          ^");
  EXPECT_EQ(message_with("\"ifov\": 1", "\"ifov\": 2"),
            "folder/a.json:3:11: 'ifov' is the number 2, expected 1, the version of the format that this "
            "program reads\n"
            "    3 |   \"ifov\": 2,\n"
            "      |           ^");
}

TEST(DocumentMessages, ADocumentDoesNotWriteOutsideOfItsFolder) {
  const std::string given = "\"folder\": \"products\"";
  for (const std::string bad : {"/tmp/products", "../products", "products/../../elsewhere", ".."})
    EXPECT_EQ(
        first_line_with(given, "\"folder\": \"" + bad + "\""),
        "folder/a.json:42:24: 'output.folder' is the text \"" + bad +
            "\", expected the name of a folder beside the document or below it; 'ifov render --output FOLDER' "
            "writes anywhere");
  for (const std::string good : {"products/red", "a..b", "."})
    EXPECT_EQ(first_line_with(given, "\"folder\": \"" + good + "\""), "accepted") << good;
}

TEST(DocumentMessages, ProductsHavePlainNames) {
  const std::string given = "\"folder\": \"products\"";
  for (const std::string bad : {"a/b", ".hidden", "a.b", "-o", "a b", "\u00e4"})
    EXPECT_EQ(first_line_with(given, "\"name\": \"" + bad + "\""),
              "folder/a.json:42:22: 'output.name' is the text \"" + bad +
                  "\", expected letters, digits, '-' and '_', of which the first is no '-', at most 100");
  for (const std::string good : {"flight-7_b", "_", "7"})
    EXPECT_EQ(first_line_with(given, "\"name\": \"" + good + "\""), "accepted") << good;
  EXPECT_EQ(
      first_line_with(given, "\"products\": [\"half_width\", \"radiances\"]"),
      "folder/a.json:42:41: 'output.products[1]' is the text \"radiances\", expected 'radiance', "
      "'standard_error', 'half_width', 'air_half_width', 'air_model_error', 'thermal_half_width', 'radiance_per_nm', "
      "'radiance_per_nm_half_width', 'band_radiance', 'band_radiance_half_width', 'photon_radiance', 'photon_radiance_half_width', "
      "'toa_reflectance', 'toa_reflectance_half_width', 'brightness_temperature', 'brightness_temperature_half_width', 'mosaic', "
      "'mosaic_half_width', 'mosaic_channels', 'samples', 'quality', 'reasons', 'quality_class', 'abundance' and 43 more; did you mean "
      "'radiance'?");
}

TEST(DocumentMessages, NamesThatAreNotDeclared) {
  EXPECT_EQ(
      message_with("{\"plane\": {}, \"material\": \"soil\"}", "{\"plane\": {}, \"material\": \"siol\"}"),
      "folder/a.json:16:33: there is no material 'siol'; did you mean 'soil'? (declared: 'soil' and 'leaf')\n"
      "   16 |       {\"plane\": {}, \"material\": \"siol\"},\n"
      "      |                                 ^");
  EXPECT_EQ(first_line_with("\"of\": \"tree\"", "\"of\": \"bush\""),
            "folder/a.json:25:28: there is no prototype 'bush' (declared: 'tree')");
  EXPECT_EQ(first_line_with("\"channel\": \"8.5 um\"", "\"channel\": \"8.5um\""),
            "folder/a.json:41:58: there is no channel '8.5um'; did you mean '8.5 um'? (declared: 'red', '400 "
            "nm', '450 nm', '500 nm' and '8.5 um')");
}

TEST(DocumentMessages, WhatSectionsNeedOfEachOther) {
  EXPECT_EQ(message_with("{\"zenith\": \"30 deg\", \"azimuth\": \"180 deg\"}", "{}"), "accepted");
  const std::string without_time = "\"time\": \"2026-06-21T17:00:00Z\",\n  ";
  std::string text = document_with("{\"zenith\": \"30 deg\", \"azimuth\": \"180 deg\"}", "{}");
  text.erase(text.find(without_time), without_time.size());
  try {
    parse_document(text, "a.json");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "a.json:28:21: the Sun has no direction: give 'zenith' and 'azimuth', or the document's 'time'\n"
        "   28 |     \"sun\": {\"disc\": {}},\n"
        "      |                     ^");
    EXPECT_EQ(error.position().line, 28);
    EXPECT_EQ(error.position().column, 21);
  }
  EXPECT_EQ(message_with("\"psf\": {\"gaussian\": {\"sigma\": \"0.6 px\"}}",
                         "\"psf\": {\"airy\": {\"aperture\": \"1 cm\", \"wavelength\": \"1 um\"}}"),
            "folder/a.json:39:12: an Airy PSF needs a 'frame' camera, whose focal length and pitch give its "
            "size in "
            "pixels, or 'optics.focal_length' and 'detector.pitch'\n"
            "   39 |     \"psf\": {\"airy\": {\"aperture\": \"1 cm\", \"wavelength\": \"1 um\"}}\n"
            "      |            ^");
  EXPECT_EQ(message_with("{\"monochromatic\": {\"at\": \"8.5 um\"}}",
                         "{\"name\": \"red\", \"monochromatic\": {\"at\": \"8.5 um\"}}"),
            "folder/a.json:37:7: two channels are named 'red'; give one a 'name' of its own\n"
            "   37 |       {\"name\": \"red\", \"monochromatic\": {\"at\": \"8.5 um\"}}\n"
            "      |       ^");
}

TEST(DocumentMessages, Geometry) {
  EXPECT_EQ(
      first_line_with("\"plane\": {}",
                      "\"polygon\": {\"vertices\": [[\"0 m\", \"0 m\", \"0 m\"], [\"1 m\", \"0 m\", \"0 "
                      "m\"], [\"2 m\", \"0 m\", \"0 m\"]]}"),
      "folder/a.json:16:32: 'scene.objects[0].polygon.vertices' enclose no area");
  EXPECT_EQ(first_line_with(
                "\"plane\": {}",
                "\"box\": {\"low\": [\"0 m\", \"0 m\", \"1 m\"], \"high\": [\"1 m\", \"1 m\", \"1 m\"]}"),
            "folder/a.json:16:54: 'scene.objects[0].box.high' is not above 'low' in every coordinate");
}

TEST(DocumentMessages, LaterStagesGetTheSameExcerpt) {
  const Document document = parse_document(test::kDocument, "folder/a.json");
  const InputError located =
      document_error(document.sources, document.scene.objects[1].shape_position, "this is too round");
  EXPECT_STREQ(located.what(),
               "folder/a.json:19:9: this is too round\n"
               "   19 |         \"sphere\": {\n"
               "      |         ^");
  const InputError elsewhere =
      document_error(document.sources, {"mesh.obj", 7, 2}, "a face without vertices");
  EXPECT_STREQ(elsewhere.what(), "mesh.obj:7:2: a face without vertices");
  const InputError whole = document_error(document.sources, {}, "too large");
  EXPECT_STREQ(whole.what(), "folder/a.json: too large");
}

}  // namespace
}  // namespace ifov::io::test_document_messages
