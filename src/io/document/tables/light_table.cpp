#include "io/document/light_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"

namespace ifov::io {
namespace {

/// Keys for where it stands, both or neither.
template <class Source>
void with_direction(Record<Source>& record, const std::string& body, double lowest_deg,
                    const std::string& beyond = "") {
  record
      .optional("zenith", path(&Source::direction, &CelestialDirection::zenith_rad),
                quantity(kAngle, Range::between(0.0, lowest_deg, "deg")),
                "zenith angle" + beyond + "; without it the " + body + " stands where time and place put it")
      .optional("azimuth", path(&Source::direction, &CelestialDirection::azimuth_rad),
                quantity(kAngle, Range::between(-360.0, 360.0, "deg")),
                "of the " + body + ", clockwise from north")
      .needs("zenith", "azimuth")
      .needs("azimuth", "zenith");
}

Record<SunDocument> sun_record(const std::string& name, const std::string& doc) {
  Record<SunDocument> record(name, doc);
  with_direction(record, "Sun", 96.0,
                 ", beyond 90 deg below the horizon, whence it lights a modelled atmosphere");
  record
      .optional("distance", &SunDocument::distance_au, quantity(kSunDistance, Range::between(0.5, 2.0, "au")),
                "of the Sun; without it from the document's time, else 1 au")
      .optional("spectrum", &SunDocument::irradiance, spectrum_type(SpectrumOf::irradiance),
                "irradiance at 1 au; without it a built-in solar spectrum");
  return record;
}

SchemaType<SunDocument> sun_type() {
  Record<SunDocument> disc =
      sun_record("disc sun", "The Sun as a disc of uniform brightness; shadows have penumbrae.");
  disc.with_default("diameter", &SunDocument::diameter_rad,
                    quantity(kAngle, Range::between(0.01, 10.0, "deg")), "\"0.53 deg\"", "angular diameter");
  const auto point = sun_record("point sun", "The Sun as a point; shadows are sharp.");
  Record<SunDocument> record("sun", "Direct sunlight.");
  const auto where = [](bool is_point) {
    return via([](SunDocument& sun, SunDocument model) { sun = std::move(model); },
               [is_point](const SunDocument& sun) {
                 return (sun.diameter_rad == 0.0) == is_point ? &sun : nullptr;
               });
  };
  record.exactly_one()
      .one("disc", where(false), disc.type(), "the Sun as a disc")
      .one("point", where(true), point.type(), "the Sun as a point");
  return record.type();
}

SchemaType<MoonDocument> moon_type() {
  Record<MoonDocument> record(
      "moon",
      "Moonlight, where the Sun is left out or below the horizon (in a modelled atmosphere by more than 6 deg): the solar spectrum, dimmed by phase and "
      "distance.");
  with_direction(record, "Moon", 90.0);
  record.optional(
      "phase_angle", &MoonDocument::phase_angle_rad, quantity(kAngle, Range::between(0.0, 180.0, "deg")),
      "at the Moon, between Sun and scene: 0 is full, 90 half; without it from the document's time");
  return record.type();
}

struct SkyEntry {
  std::variant<NoSky, SkyTemperature, SkyRadiance> sky;
  SourcePosition position;
};

SchemaType<SkyEntry> sky_type() {
  Record<SkyEntry> record("sky", "The same in every direction above the horizon.");
  record.exactly_one()
      .one("none", &SkyEntry::sky, Record<NoSky>("no sky", "No light from the sky.").type(), "a black sky")
      .one("temperature",
           via([](SkyEntry& e, double k) { e.sky = SkyTemperature{k}; },
               [](const SkyEntry& e) {
                 const auto* sky = std::get_if<SkyTemperature>(&e.sky);
                 return sky != nullptr ? &sky->temperature_k : nullptr;
               }),
           quantity(kTemperature, Range::at_least(0.0, "K")), "a blackbody of this temperature")
      .one("radiance",
           via([](SkyEntry& e, SpectrumDocument s) { e.sky = SkyRadiance{std::move(s)}; },
               [](const SkyEntry& e) {
                 const auto* sky = std::get_if<SkyRadiance>(&e.sky);
                 return sky != nullptr ? &sky->radiance : nullptr;
               }),
           spectrum_type(SpectrumOf::radiance), "spectral radiance");
  return record.type();
}

SchemaType<SurroundingsDocument> surroundings_type() {
  const auto store = [](bool is_emissivity) {
    return via(
        [is_emissivity](SurroundingsDocument& s, SpectrumDocument spectrum) {
          s.is_emissivity = is_emissivity;
          s.spectrum = std::move(spectrum);
        },
        [is_emissivity](const SurroundingsDocument& s) {
          return !s.material && s.is_emissivity == is_emissivity ? &s.spectrum : nullptr;
        });
  };
  Record<SurroundingsDocument> record(
      "surroundings",
      "What rays meet that leave the scene below the horizon, and what the air gets from all around: level ground lit by Sun and "
      "sky.");
  record.exactly_one()
      .one("reflectance", store(false), spectrum_type(SpectrumOf::reflectance),
           "spectral reflectance, alike in every direction")
      .one("emissivity", store(true), spectrum_type(SpectrumOf::emissivity),
           "spectral emissivity, alike in every direction")
      .one("material", &SurroundingsDocument::material, name_of("a material"),
           "the name of a material, which reflects by direction as its scattering says")
      .optional("temperature", &SurroundingsDocument::temperature_k,
                quantity(kTemperature, Range::at_least(0.0, "K")),
                "without one they emit nothing, or as the material's own temperature has them emit");
  return record.type();
}

}  // namespace

SchemaType<LightDocument> light_type() {
  Record<LightDocument> record("light", "What shines on the scene. Warm surfaces always emit.");
  record.optional("sun", &LightDocument::sun, sun_type(), "without it no sunlight")
      .optional("moon", &LightDocument::moon, moon_type(), "without it no moonlight")
      .optional("sky",
                via(
                    [](LightDocument& light, SkyEntry entry) {
                      light.sky = std::move(entry.sky);
                      light.sky_position = entry.position;
                    },
                    [](const LightDocument& light) {
                      return std::holds_alternative<NoSky>(light.sky) ? std::optional<SkyEntry>()
                                                                      : SkyEntry{light.sky, {}};
                    }),
                sky_type(), "without it a black sky")
      .optional("sources", &LightDocument::lamps, lamps_type(), "lamps; without them none")
      .optional(
          "surroundings", &LightDocument::surroundings, surroundings_type(),
          "without them the mean of the ground in the picture where an atmosphere is modelled or imported, else "
          "black and cold");
  return record.type();
}

}  // namespace ifov::io
