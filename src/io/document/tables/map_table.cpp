#include <algorithm>
#include <charconv>

#include "core/format.h"
#include "io/document/file_materials_document.h"
#include "io/document/map_document.h"
#include "io/document/opacity_document.h"
#include "io/document/parameter_map_document.h"
#include "io/document/schema/made_once.h"
#include "io/document/tables/map_tables.h"
#include "io/document/tables/raster_keys.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostClasses = 65536;
constexpr std::size_t kMostImages = 16;
constexpr int kMostBands = 65535;

SchemaType<std::vector<std::pair<std::int64_t, DocumentName>>> classes_type() {
  const auto named = map_of(name_of("a material"), "materials by class number", kMostClasses);
  auto description = *named.description;
  description.pattern = "^(0|-?[1-9][0-9]{0,17})$";
  description.short_name = "materials by class number";
  return {std::make_shared<const ValueDescription>(description),
          [read = named.read](const DocumentNode& node) {
            std::vector<std::pair<std::int64_t, DocumentName>> classes;
            for (auto& [key, name] : read(node)) {
              std::int64_t number = 0;
              const auto parsed = std::from_chars(key.data(), key.data() + key.size(), number);
              if (parsed.ec != std::errc() || parsed.ptr != key.data() + key.size() ||
                  format("{}", number) != key || key.size() > 19) {
                node.given(key).fail_at_key(format("the key '{}' is not a class number of a raster", key));
              }
              classes.emplace_back(number, std::move(name));
            }
            std::sort(classes.begin(), classes.end(),
                      [](const auto& a, const auto& b) { return a.first < b.first; });
            return classes;
          },
          [write = named.write](const std::vector<std::pair<std::int64_t, DocumentName>>& classes,
                                Writing& writing) {
            std::vector<std::pair<std::string, DocumentName>> by_key;
            for (const auto& [number, name] : classes) by_key.emplace_back(format("{}", number), name);
            return write(by_key, writing);
          }};
}

SchemaType<TextureImage> texture_image_type() {
  Record<TextureImage> record(
      "texture image",
      "A picture of the material, or of another like it; brighter cells take brighter curves.");
  add_raster_keys(record);
  record
      .with_default("band", &TextureImage::band, integer(1, kMostBands), "1",
                    "band of the raster, counted from 1")
      .required("from", &TextureImage::from_um, quantity(kWavelength, Range::above(0.0, "um")),
                "shortest wavelength that the picture was taken in")
      .required("to", &TextureImage::to_um, quantity(kWavelength, Range::above(0.0, "um")),
                "longest wavelength")
      .check([](const TextureImage& image, const DocumentNode& node) {
        if (!(image.from_um < image.to_um))
          node.given("to").fail_at_key("'to' must be a longer wavelength than 'from'");
      });
  return record.type();
}

SchemaType<std::shared_ptr<const FileMaterials>> file_materials_type(const SchemaType<DocumentName>& name) {
  Record<FileMaterials::Colour> colour("colour of a material",
                                       "A colour of the file's pictures, and what it stands for.");
  colour
      .required("srgb", &FileMaterials::Colour::srgb, tuple<int, 3>(integer(0, 255)),
                "red, green and blue as pictures have them, bytes of sRGB")
      .required("material", &FileMaterials::Colour::material, name, "what is there");
  Record<FileMaterials> record(
      "materials of a mesh file",
      "What the file of a mesh says of its materials: base colours of glTF, Kd and map_Kd of an OBJ's library, the picture of a PLY. A "
      "colour is no reflectance: what is made of it is a guess, and is said to be one.");
  record
      .optional(
          "colours", &FileMaterials::colours, list(colour.type(), 1, kMostClasses),
          "materials of the document by colour: each cell of a picture takes the one whose colour looks most like it; without the "
          "key, reflectances are made of the colours themselves (Jakob and Hanika 2019), between 0.38 and 0.78 um")
      .optional(
          "reflectance_beyond", &FileMaterials::beyond, spectrum_type(SpectrumOf::reflectance),
          "reflectance outside of 0.38 to 0.78 um, where a colour says nothing; without it the ends go on")
      .optional("slots", &FileMaterials::slots,
                map_of(name, "materials by the names in the mesh file", kMostClasses),
                "materials of the document in place of some of the file")
      .check([](const FileMaterials& materials, const DocumentNode& node) {
        if (!materials.colours.empty() && materials.beyond)
          node.find("reflectance_beyond")
              ->fail_at_key(
                  "'reflectance_beyond' is for reflectances that are made of colours; with 'colours' the materials "
                  "of the document have their own");
      });
  return converted<std::shared_ptr<const FileMaterials>>(
      record.type(),
      [](FileMaterials materials) { return std::make_shared<const FileMaterials>(std::move(materials)); },
      [](const std::shared_ptr<const FileMaterials>& materials) {
        return materials ? std::optional(*materials) : std::nullopt;
      });
}

SchemaType<ParameterMap> made_parameter_map_type(ParameterKind kind) {
  const bool plain = kind == ParameterKind::number;
  const std::string of = plain ? "numbers" : kind == ParameterKind::angle ? "angles" : "lengths";
  Record<ParameterMap> record(
      "map of " + of, "A parameter of a scattering model from a raster; a cell's value holds in all of it.");
  const SchemaType<double> value = plain                          ? number()
                                   : kind == ParameterKind::angle ? quantity(kAngle)
                                                                  : quantity(kLength);
  const char* zero = plain ? "0" : kind == ParameterKind::angle ? "\"0 deg\"" : "\"0 mm\"";
  const char* one = plain ? "1" : kind == ParameterKind::angle ? "\"1 deg\"" : "\"1 mm\"";
  add_raster_keys(record);
  record
      .with_default("band", &ParameterMap::band, integer(1, kMostBands), "1",
                    "band of the raster, counted from 1")
      .with_default("unit", &ParameterMap::unit, value, one,
                    "what the number 1 of the raster adds: of an image of bytes 1/255 makes 0 to 1 of it")
      .with_default("offset", &ParameterMap::offset, value, zero, "what the number 0 of the raster means");
  return record.type();
}

}  // namespace

SchemaType<TemperatureMap> temperature_map_type() {
  Record<TemperatureMap> record("temperature map", "Temperatures from a raster, bilinear between its cells.");
  add_raster_keys(record);
  record.required("unit", &TemperatureMap::offset_k, choice<double>({{"K", 0.0}, {"degC", 273.15}}),
                  "unit of the raster's numbers");
  return record.type();
}

SchemaType<ParameterMap> parameter_map_type(ParameterKind kind) {
  return made_once<made_parameter_map_type>(kind);
}

SchemaType<TextureDocument> texture_type() {
  Record<TextureDocument> record(
      "texture",
      "Picks the curve of a material with several of them from images, by matching statistics: a cell that lies so many "
      "standard deviations above its image's mean takes the curve that lies as many above the mean of the curves, or a "
      "mixture of two.");
  record
      .required("images", &TextureDocument::images, list(texture_image_type(), 1, kMostImages),
                "one or more images, each of a spectral range")
      .with_default(
          "matching", &TextureDocument::covariance, choice<bool>({{"plain", false}, {"covariance", true}}),
          "\"plain\"",
          "how distances in several ranges add up: equally, or by Mahalanobis's distance, in which ranges that "
          "go together count once");
  return record.type();
}

SchemaType<ReliefDocument> relief_type() {
  Record<HeightRelief> heights("relief of heights", "Heights above the surface, draped from above.");
  add_raster_keys(heights);
  heights.required("unit", &HeightRelief::unit_m, quantity(kLength, Range::above(0.0, "m")),
                   "height that the number 1 of the raster means");
  Record<NormalRelief> normals(
      "relief of normals", "Normals, draped from above: three bands, x to the east, y to the north, z up.");
  add_raster_keys(normals);
  struct Coding {
    double factor, offset;
    bool operator==(const Coding&) const = default;
  };
  normals.with_default("coding",
                       via(
                           [](NormalRelief& n, Coding coding) {
                             n.factor = coding.factor;
                             n.offset = coding.offset;
                           },
                           [](const NormalRelief& n) {
                             return Coding{n.factor, n.offset};
                           }),
                       choice<Coding>({{"0 to 255", {2.0 / 255.0, -1.0}}, {"-1 to 1", {1.0, 0.0}}}),
                       "\"0 to 255\"", "how components from -1 to 1 are written");
  Record<ReliefDocument> record(
      "relief", "Relief finer than the geometry: tilts the surface for light, and moves nothing.");
  record.exactly_one()
      .one("heights", &ReliefDocument::value, heights.type(), "from heights")
      .one("normals", &ReliefDocument::value, normals.type(), "from normals");
  return record.type();
}

SchemaType<OpacityDocument> opacity_type() {
  Record<OpacityDocument> record(
      "opacity map",
      "Holes of a surface (leaves, fences, railings): where the map says so, light goes straight on, to the sensor and from every "
      "source. A cell's number holds in all of it. For meshes, polygons and terrains that are meshes.");
  add_raster_keys(record);
  record
      .with_default(
          "band", &OpacityDocument::band, integer(1, kMostBands), "1",
          "band of the raster, counted from 1; of a picture with red, green, blue and opacity the fourth")
      .required(
          "cutoff", &OpacityDocument::cutoff, number(),
          "number of the raster below which there is a hole (of bytes mostly 128); cells without a number are holes");
  return record.type();
}

SchemaType<MaterialBinding> binding_type() {
  const SchemaType<DocumentName> name = name_of("a material");
  const auto direct = located<MaterialBinding>(
      name,
      [](DocumentName material, const DocumentNode& node) {
        return MaterialBinding{std::move(material), node.position()};
      },
      [](const MaterialBinding& binding) { return target::as<DocumentName>(binding.value); });
  Record<MaterialMap> map("material map", "Materials by the class numbers of a raster.");
  add_raster_keys(map);
  map.required("classes", &MaterialMap::classes, classes_type(), "material of each class number");
  Record<MixtureDocument> mixture(
      "mixture map",
      "Fractions of materials from the bands of a raster. What does not sum to 1 is rescaled, and the log says so; of a "
      "cell with more than four materials the four largest stay.");
  add_raster_keys(mixture);
  mixture.required("materials", &MixtureDocument::materials,
                   list(name, 1, static_cast<std::size_t>(kMostBands)),
                   "material of each band, in their order");
  const auto slots = converted<MaterialSlots>(
      map_of(name, "materials by the names in the mesh file", kMostClasses),
      [](std::vector<std::pair<std::string, DocumentName>> s) { return MaterialSlots{std::move(s)}; },
      [](const MaterialSlots& named) { return named.slots; });
  Record<MaterialBinding> several("materials of an object", "More than one material on an object.");
  several.exactly_one()
      .one("map", &MaterialBinding::value, map.type(), "by place")
      .one("mixture", &MaterialBinding::value, mixture.type(), "side by side in every place")
      .one("slots", &MaterialBinding::value, slots, "by the names that a mesh file uses (usemtl)")
      .one("from_file", &MaterialBinding::value, file_materials_type(name), "as the mesh file tells them");
  return either(direct, several.type());
}

SchemaType<TerrainShape> terrain_type() {
  Record<TerrainShape> record(
      "terrain",
      "A digital elevation model, placed by its georeference; a height stands for the middle of "
      "its cell.");
  record.required("file", &TerrainShape::file, file(), "a raster that GDAL reads")
      .with_default("band", &TerrainShape::band, integer(1, kMostBands), "1",
                    "band of the heights, counted from 1");
  add_placement_keys(record, &TerrainShape::placement);
  record
      .with_default(
          "detail", &TerrainShape::detail_m, quantity(kLength, Range::at_least(0.0, "m")), "\"0 m\"",
          "triangles are made as large as leaves every height of the raster within this of the surface")
      .optional("unit", &TerrainShape::unit_m, quantity(kLength, Range::above(0.0, "m")),
                "height that the number 1 means; without it as the file says, else 1 m")
      .with_default(
          "nodata", &TerrainShape::fill, choice<bool>({{"holes", false}, {"fill", true}}), "\"holes\"",
          "cells without a height: holes, or filled from the nearest cells in four quadrants, weighted by the "
          "inverse of their distance")
      .with_default(
          "smooth", &TerrainShape::smooth, boolean(), "true",
          "slopes, as light sees them, change smoothly from height to height; else each triangle is flat")
      .optional(
          "form", &TerrainShape::form,
          choice<TerrainShape::Form>(
              {{"mesh", TerrainShape::Form::mesh}, {"grid", TerrainShape::Form::grid}}),
          "a mesh of triangles, or the raster itself with every height (`detail` 0 and the scene's own `crs`): "
          "4 bytes a cell and nothing to build; without it the raster itself, where that is possible and it has "
          "more than a million cells");
  return record.type();
}

}  // namespace ifov::io
