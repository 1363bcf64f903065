#include "io/document/raster_keys.h"
#include "io/document/tables.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostMaterials = 10000;

Kind<TemperatureMap> temperature_map_kind() {
  Record<TemperatureMap> record("temperature map", "Temperatures from a raster draped from above.");
  add_raster_keys(record);
  record.required("unit", &TemperatureMap::offset_k, choice<double>({{"K", 0.0}, {"degC", 273.15}}),
                  "unit of the raster's numbers");
  return record.kind();
}

}  // namespace

Kind<TemperatureDocument> temperature_kind() {
  const Kind<double> constant = quantity(kTemperature, Range::at_least(0.0, "K"));
  const Kind<TemperatureDocument> uniform{constant.description,
                                          [read = constant.read](const DocumentNode& node) {
                                            return TemperatureDocument{read(node), node.position()};
                                          }};
  Record<TemperatureDocument> mapped("mapped temperature", "A temperature that differs from place to place.");
  mapped.required("map", &TemperatureDocument::value, temperature_map_kind(), "the raster");
  return either(uniform, mapped.kind());
}

Kind<std::vector<std::pair<std::string, MaterialDocument>>> materials_kind() {
  const Kind<SpectrumDocument> spectrum = spectrum_kind(SpectrumOf::fraction);
  const auto store = [](bool is_emissivity) {
    return [is_emissivity](MaterialDocument& material, SpectrumDocument value) {
      material.is_emissivity = is_emissivity;
      material.spectrum = std::move(value);
    };
  };
  Record<MaterialDocument> record("material", "An opaque surface: reflectance and emissivity sum to 1.");
  record.exactly_one()
      .one("reflectance", store(false), spectrum, "spectral reflectance")
      .one("emissivity", store(true), spectrum, "spectral emissivity")
      .optional("temperature", &MaterialDocument::temperature, temperature_kind(),
                "without one, here or on the object, a surface emits nothing")
      .with_default(
          "scattering", &MaterialDocument::scattering,
          choice<Scattering>({{"lambertian", Scattering::lambertian}, {"mirror", Scattering::mirror}}),
          "\"lambertian\"", "how the surface reflects");
  return map_of(record.kind(), "materials", kMostMaterials);
}

}  // namespace ifov::io
