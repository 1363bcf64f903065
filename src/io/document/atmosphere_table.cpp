#include "core/format.h"
#include "io/document/record.h"
#include "io/document/tables.h"

namespace ifov::io {
namespace {

using atmosphere::AerosolDescription;
using atmosphere::ProfileDescription;
using atmosphere::UserLevel;

Kind<std::string> word(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> choices;
  for (const std::string& w : words) choices.push_back({w, w});
  return choice<std::string>(choices);
}

Kind<TabulatedAtmosphere> tabulated_kind() {
  const Kind<SpectrumDocument> transmittance = spectrum_kind(SpectrumOf::fraction);
  Record<TabulatedAtmosphere> record("tabulated atmosphere", "An atmosphere given by its spectra.");
  record
      .optional("transmittance", &TabulatedAtmosphere::transmittance, transmittance,
                "from the scene to the camera")
      .optional("path_radiance", &TabulatedAtmosphere::path_radiance, spectrum_kind(SpectrumOf::radiance),
                "added on the way from the scene to the camera")
      .optional("sun_transmittance", &TabulatedAtmosphere::sun_transmittance, transmittance,
                "from the Sun to the scene");
  return record.kind();
}

Kind<AerosolDescription> aerosol_kind() {
  Record<AerosolDescription> record("aerosol", "Haze and dust (Shettle and Fenn 1979).");
  record
      .with_default("type", &AerosolDescription::type, word(atmosphere::aerosol_types()), "\"rural\"",
                    "of the lowest 2 km; \"none\": clear air at all heights")
      .at_most_one()
      .one(
          "visibility", [](AerosolDescription& a, double m) { a.visibility_km = 1e-3 * m; },
          quantity(kLength, Range::above(0.0, "m")), "meteorological range at the ground; 23 km if nothing is said")
      .one("aot550", &AerosolDescription::aot550, number(Range::at_least(0.0)),
           "vertical optical thickness of all aerosol at 550 nm")
      .optional("season", &AerosolDescription::season, word({"spring-summer", "autumn-winter"}),
                "of the air above 2 km; without it that of the profile")
      .with_default("stratosphere", &AerosolDescription::stratosphere, word(atmosphere::stratosphere_states()),
                    "\"background\"", "aerosol from 10 to 30 km");
  return record.kind();
}

Kind<UserLevel> level_kind() {
  Record<UserLevel> record("level", "The air at one altitude, as a radiosonde tells it.");
  record
      .required(
          "altitude", [](UserLevel& l, double m) { l.altitude_km = 1e-3 * m; }, quantity(kLength),
          "above mean sea level")
      .required("pressure", &UserLevel::pressure_hPa, quantity(kPressure, Range::above(0.0, "hPa")), "of the air")
      .required("temperature", &UserLevel::temperature_K, quantity(kTemperature, Range::above(0.0, "K")),
                "of the air")
      .at_most_one()
      .one(
          "humidity", [](UserLevel& l, double share) { l.relative_humidity_percent = 100.0 * share; },
          quantity(kPercent, Range::between(0.0, 100.0, "%")), "relative, over liquid water")
      .one("mixing_ratio", &UserLevel::mixing_ratio_g_kg, quantity(kMixingRatio, Range::at_least(0.0, "g/kg")),
           "water vapour to dry air, by mass");
  return record.kind();
}

/// Stores into a part of the modelled atmosphere.
template <class Part, class V>
auto into(Part part, V value) {
  return [part, value](AtmosphereDocument& document, auto v) {
    if (!document.modelled) document.modelled.emplace();
    std::invoke(part, *document.modelled).*value = std::move(v);
  };
}

}  // namespace

Kind<AtmosphereDocument> atmosphere_kind() {
  const auto air = [](ModelledAtmosphere& m) -> ProfileDescription& { return m.description.air; };
  const auto whole = [](ModelledAtmosphere& m) -> ModelledAtmosphere& { return m; };
  const auto description = [](ModelledAtmosphere& m) -> atmosphere::AtmosphereDescription& { return m.description; };
  Record<AtmosphereDocument> record("atmosphere", "What lies between Sun, scene and camera.");
  record.at_most_one()
      .one("tabulated", &AtmosphereDocument::tabulated, tabulated_kind(), "spectra; those not given change nothing")
      .one("imported", &AtmosphereDocument::imported, imported_kind(),
           "output of MODTRAN, libRadtran or any other code")
      .one("profile", into(air, &ProfileDescription::model), word(atmosphere::model_atmosphere_names()),
           "the model atmosphere (Anderson et al. 1986) that gives pressure, temperature and gases where the keys "
           "below say nothing else")
      .optional("levels", into(air, &ProfileDescription::levels), list(level_kind(), 2, 1000),
                "a profile of your own, from the ground up; the model atmosphere continues it")
      .optional(
          "ground_altitude",
          [air](AtmosphereDocument& d, double m) {
            if (!d.modelled) d.modelled.emplace();
            air(*d.modelled).ground_altitude_km = 1e-3 * m;
          },
          quantity(kLength), "above mean sea level; without it the height of the scene's origin")
      .optional("water_vapour", into(air, &ProfileDescription::water_vapour_g_cm2),
                quantity(kWaterColumn, Range::at_least(0.0, "g/cm2")), "precipitable water above the ground")
      .optional("ozone", into(air, &ProfileDescription::ozone_DU), quantity(kOzoneColumn, Range::at_least(0.0, "DU")),
                "column above the ground")
      .with_default("co2", into(air, &ProfileDescription::co2_ppm), quantity(kMixingRatioByVolume, Range::at_least(0.0, "ppm")),
                    "\"420 ppm\"", "carbon dioxide at the ground")
      .with_default("ch4", into(air, &ProfileDescription::ch4_ppm), quantity(kMixingRatioByVolume, Range::at_least(0.0, "ppm")),
                    "\"1.9 ppm\"", "methane at the ground")
      .with_default("n2o", into(air, &ProfileDescription::n2o_ppm), quantity(kMixingRatioByVolume, Range::at_least(0.0, "ppm")),
                    "\"0.335 ppm\"", "nitrous oxide at the ground")
      .optional("aerosol", into(description, &atmosphere::AtmosphereDescription::aerosol), aerosol_kind(),
                "haze and dust; without it rural aerosol of 23 km visibility")
      .optional(
          "sensor_altitude",
          [whole](AtmosphereDocument& d, double m) {
            if (!d.modelled) d.modelled.emplace();
            whole(*d.modelled).sensor_altitude_km = 1e-3 * m;
          },
          quantity(kLength, Range::above(0.0, "m")),
          "of the sensor above mean sea level; without it that of a frame camera, and above all air for an orthographic one");
  for (const char* key : {"levels", "ground_altitude", "water_vapour", "ozone", "co2", "ch4", "n2o", "aerosol", "sensor_altitude"})
    record.needs(key, "profile");
  Kind<AtmosphereDocument> kind = record.kind();
  return {kind.description, [kind](const DocumentNode& node) {
            AtmosphereDocument document = kind.read(node);
            // Defaults of the model's keys stand for nothing without a profile.
            if (node.find("profile") == nullptr) document.modelled.reset();
            return document;
          }};
}

}  // namespace ifov::io
