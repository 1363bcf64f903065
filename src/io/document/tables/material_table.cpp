#include "core/format.h"
#include "io/document/opacity_document.h"
#include "io/document/scene_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/map_tables.h"
#include "io/document/tables/tables.h"
#include "io/document/thermal_document.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostMaterials = 10000;
constexpr std::size_t kMostCurves = 100000;

SchemaType<MaterialDocument> sides_type() {
  using Sides = std::pair<DocumentName, DocumentName>;
  Record<MaterialDocument> record(
      "sides of a material",
      "A sheet whose sides are different materials, each with its temperature; what it covers that is solid shows its back within.");
  const SchemaType<DocumentName> name = name_of("a material");
  record
      .required(
          "front", path(&MaterialDocument::sides, &Sides::first), name,
          "material of the front: of a mesh's face where its corners run counter-clockwise, of a solid the outside")
      .required("back", path(&MaterialDocument::sides, &Sides::second), name,
                "material of the back, which lets through what the front does");
  return record.type();
}

}  // namespace

SchemaType<TemperatureDocument> temperature_type() {
  const SchemaType<double> constant = quantity(kTemperature, Range::at_least(0.0, "K"));
  const auto uniform = located<TemperatureDocument>(
      constant,
      [](double kelvin, const DocumentNode& node) {
        return TemperatureDocument{kelvin, node.position()};
      },
      [](const TemperatureDocument& temperature) { return target::as<double>(temperature.value); });
  const SchemaType<std::string> word = choice<std::string>({{"solved", "solved"}});
  const SchemaType<TemperatureDocument> told{
      cases_description({uniform.description, word.description}),
      [uniform](const DocumentNode& node) {
        if (node.type() != DocumentNode::Type::text) return uniform.read(node);
        if (node.text() == "air")
          node.fail(format(
              "{} is the text \"air\": of what is as warm as the air it is \"solved\", and the material "
              "has \"thermal\": {{\"air\": {{}}}}",
              node.title()));
        const bool is_word = node.text().find_first_of("0123456789") == std::string::npos;
        if (is_word && node.text() != "solved")
          node.fail_expected(uniform.description->expected + ", or \"solved\"");
        if (!is_word) return uniform.read(node);
        return TemperatureDocument{SolvedTemperatureDocument{}, node.position()};
      },
      [uniform, word](const TemperatureDocument& temperature, Writing& writing) {
        return std::holds_alternative<SolvedTemperatureDocument>(temperature.value)
                   ? word.write("solved", writing)
                   : uniform.write(temperature, writing);
      }};
  Record<TemperatureDocument> mapped("mapped temperature", "A temperature that differs from place to place.");
  mapped.required("map", &TemperatureDocument::value, temperature_map_type(), "the raster");
  return either(told, mapped.type());
}

SchemaType<std::vector<std::pair<std::string, MaterialDocument>>> materials_type() {
  const auto curves = [](SpectrumOf quantity) {
    const SchemaType<SpectrumDocument> spectrum = spectrum_type(quantity);
    return either(
        converted<std::vector<SpectrumDocument>>(
            spectrum, [](SpectrumDocument one) { return std::vector<SpectrumDocument>{std::move(one)}; },
            [](const std::vector<SpectrumDocument>& all) {
              return all.size() == 1 ? std::optional(all.front()) : std::nullopt;
            }),
        list(spectrum, 2, kMostCurves));
  };
  const auto store = [](bool is_emissivity) {
    return via(
        [is_emissivity](MaterialDocument& material, std::vector<SpectrumDocument> values) {
          material.is_emissivity = is_emissivity;
          material.spectrum = std::move(values[0]);
          values.erase(values.begin());
          material.further_curves = std::move(values);
        },
        [is_emissivity](const MaterialDocument& material) {
          std::vector<SpectrumDocument> values{material.spectrum};
          values.insert(values.end(), material.further_curves.begin(), material.further_curves.end());
          return !material.sides && material.is_emissivity == is_emissivity ? std::optional(values)
                                                                            : std::nullopt;
        });
  };
  Record<MaterialDocument> record(
      "material", "A surface: reflectance, transmittance (0 unless given) and emissivity sum to 1.");
  record.at_most_one_told()
      .one(
          "reflectance", store(false), curves(SpectrumOf::reflectance),
          "spectral reflectance, or several curves for a texture to pick from; needed (or the emissivity) unless the scattering model "
          "takes it as a factor alone on what it reflects by itself, which is 1 then")
      .one("emissivity", store(true), curves(SpectrumOf::emissivity), "spectral emissivity, likewise")
      .optional(
          "temperature", &MaterialDocument::temperature, temperature_type(),
          "\"solved\": from `weather` and `thermal`; without one, here or on the object, a surface emits nothing")
      .optional("thermal",
                via(
                    [](MaterialDocument& m, ThermalDocument thermal) {
                      m.thermal = std::make_shared<const ThermalDocument>(std::move(thermal));
                    },
                    [](const MaterialDocument& m) { return m.thermal.get(); }),
                thermal_type(),
                "what its temperature follows from, where that is \"solved\" and for `ifov temperature`")
      .optional(
          "emitter", &MaterialDocument::emitter, boolean(),
          "whether the light that it emits is sought from other surfaces; absent: where it is twice as bright as the scene; false leaves it to "
          "chance, and pixels that it may light say so")
      .with_default("scattering", &MaterialDocument::scattering, scattering_type(), "\"lambertian\"",
                    "how the surface reflects: a model by its name or, with its parameters, as an object")
      .optional("texture", &MaterialDocument::texture, texture_type(), "picks among several curves")
      .optional("relief", &MaterialDocument::relief, relief_type(), "bumps that light sees")
      .optional("opacity",
                via(
                    [](MaterialDocument& material, OpacityDocument opacity) {
                      material.opacity = std::make_shared<const OpacityDocument>(std::move(opacity));
                    },
                    [](const MaterialDocument& material) { return material.opacity.get(); }),
                opacity_type(), "holes of the surface")
      .optional(
          "transmittance", &MaterialDocument::transmittance, spectrum_type(SpectrumOf::transmittance),
          "of a thin leaf, the same from both sides: what leaves the other side, spread as Lambert's law says; "
          "emissivity is then 1 - reflectance - transmittance")
      .check([](const MaterialDocument& material, const DocumentNode& node) {
        const char* key = material.is_emissivity ? "emissivity" : "reflectance";
        if (node.find(key) == nullptr && !reflects_by_itself(material.scattering))
          node.fail(format(
              "{} needs exactly one of 'reflectance' or 'emissivity': '{}' scattering has no reflectance of its own",
              node.title(), material.scattering.model));
        if (material.temperature && material.thermal &&
            !std::holds_alternative<SolvedTemperatureDocument>(material.temperature->value))
          node.given("temperature")
              .fail_at_key(
                  "a 'temperature' is given, and 'thermal' to solve for one; give one of them, or \"solved\" as the "
                  "temperature");
        if (material.transmittance && material.is_emissivity)
          node.given("transmittance")
              .fail_at_key(
                  "give the 'reflectance' of a material with a transmittance, not its "
                  "emissivity, which follows from both");
        if (!material.further_curves.empty() && !material.texture)
          node.given(key).fail_at_key("several curves need a 'texture' that picks among them");
        if (material.texture && material.further_curves.empty())
          node.given("texture").fail_at_key(
              format("a texture picks among several curves; give a list of them as '{}'", key));
      });
  return map_of(tagged<MaterialDocument>(
                    {{{"reflectance", "emissivity"}, record.type()}, {{"front", "back"}, sides_type()}}, 0),
                "materials", kMostMaterials);
}

}  // namespace ifov::io
