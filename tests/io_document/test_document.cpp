// What comes out of a document: every section, units, defaults.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "document_maker.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/cameras/orthographic_camera.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "io/document/samplers/accuracy_sampling.h"
#include "io/document/samplers/plain_sampling.h"
#include "io/document/shapes/box_primitive.h"
#include "io/document/shapes/flat_primitives.h"
#include "io/document/shapes/round_primitives.h"

namespace ifov::io::test_document {
namespace {

using test::document_with;
using test::parsed_with;

constexpr double kDegree = std::numbers::pi / 180.0;

Document whole() { return parse_document(test::kDocument, "folder/a.json"); }

TEST(Document, Head) {
  const Document document = whole();
  EXPECT_EQ(document.version, 1);
  EXPECT_EQ(document.seed, 7u);
  ASSERT_TRUE(document.time);
  EXPECT_EQ(geodesy::format_utc(*document.time), "2026-06-21T17:00:00.000Z");
  EXPECT_EQ(document.sources.file_name, "folder/a.json");
  EXPECT_EQ(*document.text, test::kDocument);
}

TEST(Document, SeedsUpToTwoToThe53) {
  EXPECT_EQ(parsed_with("\"seed\": 7", "\"seed\": 9007199254740991").seed, 9007199254740991u);
  EXPECT_THROW(parsed_with("\"seed\": 7", "\"seed\": 9007199254740992"), InputError);
  EXPECT_THROW(parsed_with("\"seed\": 7", "\"seed\": 18446744073709551615"), InputError);
  EXPECT_THROW(parsed_with("\"seed\": 7", "\"seed\": 7.5"), InputError);
}

TEST(Document, Scene) {
  const SceneDocument scene = whole().scene;
  ASSERT_TRUE(scene.origin.geographic);
  EXPECT_NEAR(scene.origin.geographic->latitude_rad, 43.0 * kDegree, 1e-15);
  EXPECT_FALSE(scene.origin.has_map_offset);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].name, "soil");
  EXPECT_FALSE(scene.materials[0].is_emissivity);
  EXPECT_EQ(std::get<ConstantSpectrum>(scene.materials[0].spectrum.source).value, 0.25);
  EXPECT_NEAR(std::get<double>(scene.materials[0].temperature->value), 293.15, 1e-12);
  const auto& csv = std::get<CsvSpectrum>(scene.materials[1].spectrum.source);
  EXPECT_TRUE(scene.materials[1].is_emissivity);
  EXPECT_EQ(csv.file.path, "folder/leaf.csv");
  EXPECT_EQ(csv.um_per_unit, 1e-3);
  EXPECT_EQ(csv.column, 2);
  EXPECT_EQ(csv.scale, 0.01);
  ASSERT_EQ(scene.objects.size(), 3u);
  const auto& ball = *primitive_as<SpherePrimitive>(scene.objects[1].shape);
  EXPECT_EQ(ball.centre_m, (math::Point3{1.0, 2.0, 3.0}));
  EXPECT_EQ(ball.radius_m, 0.5);
  EXPECT_EQ(scene.objects[1].name, "ball");
  EXPECT_EQ(scene.objects[1].position.line, 17);
  EXPECT_EQ(scene.objects[1].shape_position.line, 19);
  EXPECT_FALSE(scene.objects[2].material);
  EXPECT_EQ(std::get<InstancesShape>(scene.objects[2].shape).of.name, "tree");
  ASSERT_EQ(scene.prototypes.size(), 1u);
  EXPECT_EQ(scene.prototypes[0].objects.size(), 1u);
}

template <class Shape>
Shape shape_from(const std::string& json) {
  const ShapeDocument shape = parsed_with("\"plane\": {}", json).scene.objects[0].shape;
  if constexpr (std::is_base_of_v<PrimitiveSettings, Shape>)
    return *primitive_as<Shape>(shape);
  else
    return std::get<Shape>(shape);
}

TEST(Document, Shapes) {
  EXPECT_EQ(shape_from<PlanePrimitive>(R"("plane": {"height": "2 m"})").height_m, 2.0);
  const auto box =
      shape_from<BoxPrimitive>(R"("box": {"low": ["0 m", "0 m", "0 m"], "high": ["1 m", "2 m", "3 m"]})");
  EXPECT_EQ(box.high_m, (math::Point3{1.0, 2.0, 3.0}));
  const auto upright = shape_from<CylinderPrimitive>(
      R"("cylinder": {"base": ["0 m", "0 m", "0 m"], "height": "2 m", "radius": "1 m", "capped": false})");
  EXPECT_EQ(upright.axis_m, (math::Vec3{0.0, 0.0, 2.0}));
  EXPECT_FALSE(upright.capped);
  const auto leaning = shape_from<CylinderPrimitive>(
      R"("cylinder": {"base": ["0 m", "0 m", "0 m"], "axis": ["1 m", "0 m", "1 m"], "radius": "1 m"})");
  EXPECT_EQ(leaning.axis_m, (math::Vec3{1.0, 0.0, 1.0}));
  EXPECT_TRUE(leaning.capped);
  const auto disk = shape_from<DiskPrimitive>(
      R"("disk": {"center": ["0 m", "0 m", "0 m"], "normal": [0, 0, 2], "radius": "1 ft"})");
  EXPECT_EQ(disk.radius_m, 0.3048);
  const auto mesh = shape_from<MeshShape>(R"("mesh": {"file": "../m.obj", "unit": "mm", "up": "y"})");
  EXPECT_EQ(mesh.file.path, "m.obj");
  EXPECT_EQ(mesh.unit_m, 1e-3);
  EXPECT_TRUE(mesh.y_is_up);
  const auto polygon = shape_from<PolygonPrimitive>(
      R"("polygon": {"vertices": [["0 m","0 m","9 m"], ["4 m","0 m","9 m"], ["1 m","1 m","9 m"], ["0 m","4 m","9 m"]]})");
  EXPECT_EQ(polygon.vertices_m.size(), 4u);
  // Rounded to a millimetre.
  EXPECT_NO_THROW(shape_from<PolygonPrimitive>(
      R"("polygon": {"vertices": [["0 m","0 m","0 m"], ["4 m","0 m","1.333 m"], ["4 m","4 m","2.666 m"], ["0 m","4 m","1.334 m"]]})"));
}

TEST(Document, PolygonsFarFromTheOriginMayBeFlatToo) {
  EXPECT_NO_THROW(shape_from<PolygonPrimitive>(
      R"("polygon": {"vertices": [["500000 m","4500000 m","9 m"], ["500004 m","4500000 m","9 m"], ["500004 m","4500004 m","9 m"]]})"));
}

TEST(Document, Bindings) {
  const auto map = std::get<MaterialMap>(
      parsed_with("{\"plane\": {}, \"material\": \"soil\"}",
                  R"({"plane": {}, "material": {"map": {"file": "c.tif", "low_left": ["0 m", "1 m"],
                  "size": ["3 m", "4 m"], "classes": {"10": "leaf", "-2": "soil"}}}})")
          .scene.objects[0]
          .material->value);
  EXPECT_EQ(map.raster.file.path, "folder/c.tif");
  EXPECT_EQ(map.raster.placement->y_m, 1.0);
  EXPECT_EQ(map.raster.placement->height_m, 4.0);
  ASSERT_EQ(map.classes.size(), 2u);
  EXPECT_EQ(map.classes[0].first, -2);
  EXPECT_EQ(map.classes[1].second.name, "leaf");
  const auto slots = std::get<MaterialSlots>(
      parsed_with("{\"plane\": {}, \"material\": \"soil\"}",
                  R"({"mesh": {"file": "m.obj"}, "material": {"slots": {"Bark": "soil"}}})")
          .scene.objects[0]
          .material->value);
  EXPECT_EQ(slots.slots[0].first, "Bark");
}

TEST(Document, TransformsAndTemperatures) {
  const ObjectDocument object = parsed_with("{\"plane\": {}, \"material\": \"soil\"}",
                                            R"({"plane": {}, "material": "soil", "pilot_ray": false,
                      "temperature": {"map": {"file": "t.tif", "unit": "degC"}},
                      "transform": {"translate": ["1 m", "0 m", "0 m"], "rotate": {"angle": "90 deg"}, "scale": 2}})")
                                    .scene.objects[0];
  EXPECT_EQ(object.transform.scale, (math::Vec3{2.0, 2.0, 2.0}));
  EXPECT_EQ(object.transform.rotation_axis, (math::Vec3{0.0, 0.0, 1.0}));
  EXPECT_NEAR(object.transform.rotation_rad, std::numbers::pi / 2.0, 1e-15);
  EXPECT_EQ(object.transform.translate_m.x, 1.0);
  EXPECT_EQ(std::get<TemperatureMap>(object.temperature->value).offset_k, 273.15);
  EXPECT_FALSE(std::get<TemperatureMap>(object.temperature->value).raster.placement);
  EXPECT_EQ(object.pilot_ray, false);
  EXPECT_FALSE(whole().scene.objects[0].pilot_ray);
}

TEST(Document, MapOriginIsAnOffset) {
  const OriginDocument origin =
      parsed_with(R"("origin": {"latitude": "43 deg", "longitude": "-77 deg"})",
                  R"("origin": {"easting": "500 km", "northing": "4500 km", "height": "12 m"})")
          .scene.origin;
  EXPECT_TRUE(origin.has_map_offset);
  EXPECT_EQ(origin.offset_m, (math::Vec3{500000.0, 4500000.0, 12.0}));
}

TEST(Document, Light) {
  const LightDocument light = whole().light;
  ASSERT_TRUE(light.sun && light.sun->direction);
  EXPECT_NEAR(light.sun->direction->zenith_rad, 30.0 * kDegree, 1e-15);
  EXPECT_NEAR(light.sun->diameter_rad, 0.53 * kDegree, 1e-15);
  EXPECT_FALSE(light.sun->distance_au);
  EXPECT_NEAR(std::get<SkyTemperature>(light.sky).temperature_k, 263.15, 1e-12);
  EXPECT_FALSE(light.surroundings);
}

TEST(Document, PointSunByTimeAndPlaceUnderARadiantSky) {
  const LightDocument light =
      parsed_with(R"({"disc": {"zenith": "30 deg", "azimuth": "180 deg"}},
    "sky": {"temperature": "-10 degC"})",
                  R"({"point": {"distance": "1.01 au", "spectrum": "1800 W m-2 um-1"}},
    "sky": {"radiance": {"table": {"wavelength": ["0.4 um", "900 nm"], "values": ["1 W/m2/sr/um", "2 uW cm-2 sr-1 nm-1"]},
                         "outside": "extend"}},
    "surroundings": {"emissivity": 0.9, "temperature": "290 K"})")
          .light;
  EXPECT_EQ(light.sun->diameter_rad, 0.0);
  EXPECT_FALSE(light.sun->direction);
  EXPECT_EQ(light.sun->distance_au, 1.01);
  EXPECT_EQ(std::get<ConstantSpectrum>(light.sun->irradiance->source).value, 1800.0);
  const SpectrumDocument& sky = std::get<SkyRadiance>(light.sky).radiance;
  EXPECT_EQ(sky.outside, OutsideRange::extend);
  const auto& table = std::get<TableSpectrum>(sky.source);
  EXPECT_NEAR(table.wavelength_um[1], 0.9, 1e-15);
  EXPECT_NEAR(table.values[1], 20.0, 1e-12);
  EXPECT_TRUE(light.surroundings->is_emissivity);
  EXPECT_EQ(light.surroundings->temperature_k, 290.0);
}

TEST(Document, SurroundingsMayBeNamedAsAMaterial) {
  const LightDocument light = parsed_with(R"("sky": {"temperature": "-10 degC"})",
                                          R"("surroundings": {"material": "sea", "temperature": "285 K"})")
                                  .light;
  ASSERT_TRUE(light.surroundings->material);
  EXPECT_EQ(light.surroundings->material->name, "sea");
  EXPECT_EQ(light.surroundings->temperature_k, 285.0);
}

TEST(Document, RadianceFromCsvTakesItsUnitIntoTheScale) {
  const auto sky = parsed_with(R"("sky": {"temperature": "-10 degC"})",
                               R"("sky": {"radiance": {"csv": "sky.csv", "wavelength_unit": "um", "scale": 2,
                               "unit": "W m-2 sr-1 nm-1"}})")
                       .light.sky;
  EXPECT_EQ(std::get<CsvSpectrum>(std::get<SkyRadiance>(sky).radiance.source).scale, 2000.0);
}

TEST(Document, Sensor) {
  const SensorDocument sensor = whole().sensor;
  const auto& camera = camera_as<OrthographicCamera>(sensor.camera)->size;
  EXPECT_EQ(camera.width_px, 30);
  EXPECT_EQ(camera.height_px, 20);
  EXPECT_FALSE(camera_as<OrthographicCamera>(sensor.camera)->height_m);
  ASSERT_EQ(sensor.channels.size(), 5u);
  EXPECT_EQ(sensor.channels[0].name, "red");
  EXPECT_EQ(sensor.channels[1].name, "400 nm");
  EXPECT_EQ(sensor.channels[2].name, "450 nm");
  EXPECT_EQ(sensor.channels[4].name, "8.5 um");
  EXPECT_NEAR(std::get<GaussianChannel>(sensor.channels[2].response).centre_um, 0.45, 1e-15);
  EXPECT_NEAR(std::get<GaussianChannel>(sensor.channels[2].response).fwhm_um, 0.01, 1e-15);
  ASSERT_NE(sensor.psf, nullptr);
  EXPECT_EQ(std::get<GaussianPsf>(sensor.psf->parts.front()).sigma_px, 0.6);
  EXPECT_EQ(sensor.fill_factor, 1.0);
}

TEST(Document, FrameCamera) {
  const std::string nadir = R"({"orthographic": {"gsd": "1 m", "pixels": [30, 20]}})";
  const auto looking = *camera_as<FrameCamera>(
      parsed_with(nadir, R"({"frame": {"focal_length": "50 mm", "pitch": "5 um", "pixels": [4, 5],
         "position": ["0 m", "0 m", "1 km"], "look_at": ["0 m", "0 m", "0 m"], "up": [0, 1, 0]}})")
          .sensor.camera);
  EXPECT_EQ(looking.focal_length_m, 0.05);
  EXPECT_NEAR(looking.pitch_m, 5e-6, 1e-20);
  EXPECT_EQ(looking.position_m.z, 1000.0);
  EXPECT_EQ(std::get<LookAt>(looking.orientation).up->y, 1.0);
  const auto turned = *camera_as<FrameCamera>(
      parsed_with(nadir, R"({"frame": {"focal_length": "50 mm", "pitch": "5 um", "pixels": [4, 5],
         "position": ["0 m", "0 m", "1 km"], "attitude": {"yaw": "10 deg", "pitch": "-10 deg"}}})")
          .sensor.camera);
  EXPECT_NEAR(std::get<geodesy::Attitude>(turned.orientation).pitch_rad, -10.0 * kDegree, 1e-15);
}

TEST(Document, SamplingMethods) {
  const auto accuracy = *sampler_as<AccuracySampling>(whole().sampling);
  EXPECT_EQ(accuracy.error.unit, ErrorSize::Unit::kelvin);
  EXPECT_EQ(accuracy.error.value, 0.1);
  EXPECT_EQ(accuracy.channel->name, "8.5 um");
  EXPECT_EQ(accuracy.confidence, 0.95);
  EXPECT_EQ(accuracy.floor, 0.001);
  EXPECT_EQ(accuracy.probes, 9);
  EXPECT_FALSE(accuracy.lattice);
  const std::string method = R"({"accuracy": {"error": "0.1 K", "channel": "8.5 um"}})";
  EXPECT_TRUE(sampler_as<SingleSampling>(parsed_with(method, R"({"single": {}})").sampling) != nullptr);
  const auto grid =
      parsed_with(method,
                  R"({"grid": {"elements": [10, 5]}, "tile": 16, "max_depth": 2, "mirror_reflections": 3})")
          .sampling;
  EXPECT_EQ(sampler_as<GridSampling>(grid)->columns, 10);
  EXPECT_EQ(sampler_as<GridSampling>(grid)->rows, 5);
  EXPECT_EQ(grid.tile_px, 16);
  EXPECT_EQ(grid.max_depth, 2);
  EXPECT_EQ(grid.mirror_reflections, 3);
  EXPECT_EQ(whole().sampling.mirror_reflections, 8);
  const auto adaptive = *sampler_as<AdaptiveSampling>(
      parsed_with(method, R"({"adaptive": {"sub_elements": [3, 3], "allowed_difference": "2 %"}})").sampling);
  EXPECT_EQ(adaptive.allowed_difference.unit, ErrorSize::Unit::fraction);
  EXPECT_EQ(adaptive.allowed_difference.value, 0.02);
  EXPECT_EQ(adaptive.max_samples, 100);
}

TEST(Document, ErrorsInFourUnits) {
  const auto error = [](const std::string& size) {
    return sampler_as<AccuracySampling>(
               parsed_with(R"({"error": "0.1 K", "channel": "8.5 um"})", "{\"error\": \"" + size + "\"}")
                   .sampling)
        ->error;
  };
  EXPECT_EQ(error("50 mK").value, 0.05);
  EXPECT_EQ(error("1%").value, 0.01);
  EXPECT_EQ(error("0.002 reflectance").unit, ErrorSize::Unit::reflectance);
  EXPECT_EQ(error("0.5 noise").unit, ErrorSize::Unit::noise);
  EXPECT_EQ(error("0.05 W/m2/sr/um").unit, ErrorSize::Unit::radiance);
}

TEST(Document, DefaultsWhereSectionsAreMissing) {
  const Document document = parse_document(R"({"ifov": 1,
    "scene": {"materials": {"a": {"emissivity": 1}}, "objects": [{"plane": {}, "material": "a"}]},
    "sensor": {"camera": {"orthographic": {"gsd": "1 m", "pixels": [1, 1]}},
               "channels": [{"top_hat": {"from": "8 um", "to": "9 um"}}]}})",
                                           "some/where/b.scene.json");
  EXPECT_EQ(document.seed, 1u);
  EXPECT_FALSE(document.time);
  EXPECT_FALSE(document.light.sun);
  EXPECT_TRUE(std::holds_alternative<NoSky>(document.light.sky));
  EXPECT_FALSE(document.atmosphere.tabulated);
  EXPECT_EQ(document.sensor.psf, nullptr);
  const auto accuracy = *sampler_as<AccuracySampling>(document.sampling);
  EXPECT_EQ(accuracy.error.value, 0.01);
  EXPECT_EQ(accuracy.error.unit, ErrorSize::Unit::fraction);
  EXPECT_EQ(document.sampling.tile_px, 64);
  EXPECT_EQ(document.output.folder, "some/where/b.scene.out");
  EXPECT_EQ(document.output.formats, (std::vector<std::string>{"envi", "png", "html"}));
  EXPECT_EQ(document.sensor.channels[0].name, "8 um to 9 um");
  EXPECT_EQ(document.light.position.file, "some/where/b.scene.json");
  EXPECT_EQ(document.sampling.position.line, 1);
}

TEST(Document, MissingFilesAreSystemErrors) {
  EXPECT_THROW(read_document("/no/such/file.json"), SystemError);
  EXPECT_THROW(read_document("/tmp"), SystemError);
}

}  // namespace
}  // namespace ifov::io::test_document
