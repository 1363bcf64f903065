#include "atmosphere/profile/gas_requests.h"
#include "core/format.h"
#include "io/document/aerosol_document.h"
#include "io/document/atmosphere_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

using atmosphere::ProfileDescription;
using atmosphere::UserLevel;

SchemaType<TabulatedAtmosphere> tabulated_atmosphere_type() {
  const SchemaType<SpectrumDocument> transmittance = spectrum_type(SpectrumOf::fraction);
  Record<TabulatedAtmosphere> record("tabulated atmosphere", "An atmosphere given by its spectra.");
  record
      .optional("transmittance", &TabulatedAtmosphere::transmittance, transmittance,
                "from the scene to the camera")
      .optional("path_radiance", &TabulatedAtmosphere::path_radiance, spectrum_type(SpectrumOf::radiance),
                "added on the way from the scene to the camera")
      .optional("sun_transmittance", &TabulatedAtmosphere::sun_transmittance, transmittance,
                "from the Sun to the scene");
  return record.type();
}

SchemaType<SimpleAtmosphere> simple_type() {
  Record<SimpleAtmosphere> record(
      "simple atmosphere",
      "A Sun of 5800 K that gives 1000 W m-2 across its beam, a black sky that glows, and "
      "air that neither absorbs nor shines.");
  record.required("sky_temperature", &SimpleAtmosphere::sky_temperature_k,
                  quantity(kTemperature, Range::at_least(0.0, "K")), "of the sky as a blackbody");
  return record.type();
}

SchemaType<UniformAtmosphere> uniform_type() {
  const SchemaType<double> irradiance = quantity(kIrradiance, Range::at_least(0.0, "W m-2 um-1"));
  Record<UniformAtmosphere> record(
      "uniform atmosphere", "The same light at all wavelengths, and air that neither absorbs nor shines.");
  record
      .required("direct", &UniformAtmosphere::direct_w_m2_um, irradiance,
                "of the Sun at the ground, across its beam")
      .required("diffuse", &UniformAtmosphere::diffuse_w_m2_um, irradiance,
                "of the sky, the same in every direction, on level ground");
  return record.type();
}

SchemaType<FourCurveAtmosphere> four_curve_type() {
  Record<FourCurveAtmosphere> record(
      "four-curve atmosphere",
      "Light at the ground, and air that is the same all along the path to the camera.");
  record
      .required("direct", &FourCurveAtmosphere::direct, spectrum_type(SpectrumOf::irradiance),
                "of the Sun at the ground, across its beam")
      .required("diffuse", &FourCurveAtmosphere::diffuse, spectrum_type(SpectrumOf::irradiance),
                "of the sky, the same in every direction, on level ground")
      .required("transmittance", &FourCurveAtmosphere::transmittance, spectrum_type(SpectrumOf::fraction),
                "of a length of path")
      .required("path_radiance", &FourCurveAtmosphere::path_radiance, spectrum_type(SpectrumOf::radiance),
                "that a length of path adds")
      .with_default("length", &FourCurveAtmosphere::length_m, quantity(kLength, Range::above(0.0, "m")),
                    "\"1 m\"", "the length that transmittance and path radiance are for")
      .required("distance", &FourCurveAtmosphere::distance_m, quantity(kLength, Range::at_least(0.0, "m")),
                "from the scene to the camera, the same for all pixels");
  return record.type();
}

SchemaType<UserLevel> level_type() {
  Record<UserLevel> record("level", "The air at one altitude, as a radiosonde tells it.");
  record.required("altitude", &UserLevel::altitude_km, quantity(kLength, {}, 1e-3), "above mean sea level")
      .required("pressure", &UserLevel::pressure_hPa, quantity(kPressure, Range::above(0.0, "hPa")),
                "of the air")
      .required("temperature", &UserLevel::temperature_K, quantity(kTemperature, Range::above(0.0, "K")),
                "of the air")
      .at_most_one()
      .one("humidity", &UserLevel::relative_humidity_percent,
           quantity(kPercent, Range::between(0.0, 100.0, "%"), 100.0), "relative, over liquid water")
      .one("mixing_ratio", &UserLevel::mixing_ratio_g_kg,
           quantity(kMixingRatio, Range::at_least(0.0, "g/kg")), "water vapour to dry air, by mass");
  return record.type();
}

/// Where a level of a profile stands on another, or weighs more than it.
void check_levels(const DocumentNode& atmosphere, const std::vector<UserLevel>& levels) {
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const UserLevel &below = levels[k - 1], &here = levels[k];
    const DocumentNode& node = atmosphere.given("levels").items()[k];
    if (!(here.altitude_km > below.altitude_km))
      node.given("altitude")
          .fail(format("the altitudes of a profile must rise: {:g} km follows {:g} km", here.altitude_km,
                       below.altitude_km));
    if (!(here.pressure_hPa < below.pressure_hPa))
      node.given("pressure")
          .fail(format("the pressures of a profile must fall: {:g} hPa follows {:g} hPa", here.pressure_hPa,
                       below.pressure_hPa));
  }
}

/// Gases that have a key of their own and are told of under 'gases', too.
void check_told_once(const DocumentNode& atmosphere) {
  const DocumentNode* gases = atmosphere.find("gases");
  if (gases == nullptr) return;
  for (const auto& [key, gas] : {std::pair{"water_vapour", "h2o"}, std::pair{"ozone", "o3"},
                                 std::pair{"co2", "co2"}, std::pair{"ch4", "ch4"}, std::pair{"n2o", "n2o"}})
    if (const DocumentNode* other = gases->find(gas); other != nullptr && atmosphere.find(key) != nullptr)
      other->fail_at_key(
          format("'{}' of 'gases' and the atmosphere's '{}' are of the same gas: leave one out", gas, key));
}

/// A value of the modelled atmosphere.
template <class... Members>
auto modelled(Members... members) {
  return path(&AtmosphereDocument::modelled, members...);
}
/// A value of its profile.
template <class Member>
auto profile(Member member) {
  return modelled(&ModelledAtmosphere::description, &atmosphere::AtmosphereDescription::air, member);
}

}  // namespace

SchemaType<std::string> word_type(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> choices;
  for (const std::string& w : words) choices.push_back({w, w});
  return choice<std::string>(choices);
}

SchemaType<AtmosphereDocument> atmosphere_type() {
  Record<AtmosphereDocument> record("atmosphere", "What lies between Sun, scene and camera.");
  record.at_most_one()
      .one("tabulated", &AtmosphereDocument::tabulated, tabulated_atmosphere_type(),
           "spectra; those not given change nothing")
      .one("imported", &AtmosphereDocument::imported, imported_type(),
           "output of MODTRAN, libRadtran or any other code")
      .one("simple", &AtmosphereDocument::simple, simple_type(), "no air, a Sun like a blackbody")
      .one("uniform", &AtmosphereDocument::uniform, uniform_type(), "no air, light without colour")
      .one("four_curve", &AtmosphereDocument::four_curve, four_curve_type(),
           "four spectra, the same for every path")
      .one(
          "profile", profile(&ProfileDescription::model), word_type(atmosphere::model_atmosphere_names()),
          "the model atmosphere (Anderson et al. 1986) that gives pressure, temperature and gases where the keys "
          "below say nothing else")
      .optional("levels", profile(&ProfileDescription::levels), list(level_type(), 2, 1000),
                "a profile of your own, from the ground up; the model atmosphere continues it")
      .optional("ground_altitude", profile(&ProfileDescription::ground_altitude_km),
                quantity(kLength, {}, 1e-3),
                "above mean sea level; without it the height of the scene's origin")
      .optional("water_vapour", profile(&ProfileDescription::water_vapour_g_cm2),
                quantity(kWaterColumn, Range::at_least(0.0, "g/cm2")), "precipitable water above the ground")
      .optional("ozone", profile(&ProfileDescription::ozone_DU),
                quantity(kOzoneColumn, Range::at_least(0.0, "DU")), "column above the ground")
      .with_default("co2", profile(&ProfileDescription::co2_ppm),
                    quantity(kMixingRatioByVolume, Range::between(0.0, 1e6, "ppm")), "\"420 ppm\"",
                    "carbon dioxide at the ground")
      .with_default("ch4", profile(&ProfileDescription::ch4_ppm),
                    quantity(kMixingRatioByVolume, Range::between(0.0, 1e6, "ppm")), "\"1.9 ppm\"",
                    "methane at the ground")
      .with_default("n2o", profile(&ProfileDescription::n2o_ppm),
                    quantity(kMixingRatioByVolume, Range::between(0.0, 1e6, "ppm")), "\"0.335 ppm\"",
                    "nitrous oxide at the ground")
      .optional(
          "gases",
          via(
              [](AtmosphereDocument& document, const atmosphere::GasRequests& gases) {
                if (!document.modelled) document.modelled.emplace();
                document.modelled->description.air.gases =
                    std::make_shared<const atmosphere::GasRequests>(gases);
              },
              [](const AtmosphereDocument& document) {
                return document.modelled ? document.modelled->description.air.gases.get() : nullptr;
              }),
          gases_type(),
          "amounts of any gas: switched off, scaled to a column or a mixing ratio, or by a profile of your own")
      .optional(
          "gas_model", modelled(&ModelledAtmosphere::gas_model), file(),
          "[terms](gas_model.md) of gases from spectra line by line, in place of the built-in bands of these gases: for channels "
          "narrower than 20 cm-1. Each channel lies within its range, or outside")
      .optional("aerosol",
                via(
                    [](AtmosphereDocument& document, const AerosolDocument& aerosol) {
                      if (!document.modelled) document.modelled.emplace();
                      document.modelled->aerosol = std::make_shared<const AerosolDocument>(aerosol);
                    },
                    [](const AtmosphereDocument& document) {
                      return document.modelled ? document.modelled->aerosol.get() : nullptr;
                    }),
                aerosol_type(), "haze and dust; without it rural aerosol of 23 km visibility")
      .optional(
          "clouds", modelled(&ModelledAtmosphere::clouds), clouds_type(),
          "level layers of droplets or ice crystals, beside haze and dust; without them the sky is clear")
      .optional(
          "sensor_altitude", modelled(&ModelledAtmosphere::sensor_altitude_km),
          quantity(kLength, Range::above(0.0, "m"), 1e-3),
          "of the sensor above mean sea level; without it that of a frame camera, and above all air for an orthographic one")
      .with_default(
          "adjacency", modelled(&ModelledAtmosphere::adjacency), boolean(), "true",
          "whether the scene's own ground lights the air about each pixel; `false`: the surroundings alone do")
      .with_default(
          "interval", modelled(&ModelledAtmosphere::interval), word_type({"numerical", "with model"}),
          "\"with model\"",
          "what intervals hold of the air: how exactly this model is computed, and how far it may be from the air besides, or "
          "(\"numerical\") the first alone; what is asked for is judged by what they hold");
  for (const char* key : {"levels", "ground_altitude", "water_vapour", "ozone", "co2", "ch4", "n2o", "gases",
                          "gas_model", "aerosol", "clouds", "sensor_altitude", "adjacency", "interval"})
    record.needs(key, "profile");
  SchemaType<AtmosphereDocument> type = record.type();
  return {type.description,
          [type](const DocumentNode& node) {
            AtmosphereDocument document = type.read(node);
            // Defaults of the model's keys stand for nothing without a profile.
            if (node.find("profile") == nullptr) document.modelled.reset();
            if (document.modelled) {
              const ProfileDescription& profile = document.modelled->description.air;
              check_levels(node, profile.levels);
              check_told_once(node);
              const std::optional<double>& sensor_km = document.modelled->sensor_altitude_km;
              if (sensor_km && profile.ground_altitude_km && *sensor_km <= *profile.ground_altitude_km)
                node.find("sensor_altitude")
                    ->fail(format("the sensor stands at {:g} km, not above the ground at {:g} km", *sensor_km,
                                  *profile.ground_altitude_km));
            }
            return document;
          },
          type.write};
}

}  // namespace ifov::io
