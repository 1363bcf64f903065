#include "atmosphere/profile/profile.h"
#include "core/format.h"
#include "io/document/aerosol_document.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"
#include "radiometry/refractive_index.h"

namespace ifov::io {
namespace {

using atmosphere::AerosolDescription;

constexpr const char* kDepth = "optical_depth";

template <class Member>
auto tables(Member member) {
  return path(&AerosolDocument::tables, member);
}
template <class Member>
auto own(Member member) {
  return path(&AerosolDocument::own, member);
}

SpectrumDocument constant(double value) {
  SpectrumDocument spectrum;
  spectrum.source = ConstantSpectrum{value};
  spectrum.quantity = SpectrumOf::number;
  return spectrum;
}

/// "water", [1.45, 0.005], or spectra of both.
SchemaType<IndexDocument> index_type() {
  const SchemaType<std::string> names = label();
  const SchemaType<std::vector<double>> pair = list(number(Range::at_least(0.0)), 2, 2);
  Record<IndexDocument> record("index of refraction",
                               "n + ik by wavelength; k is above 0 where light is absorbed.");
  record.required("n", &IndexDocument::n, spectrum_type(SpectrumOf::number), "real part")
      .required("k", &IndexDocument::k, spectrum_type(SpectrumOf::number), "imaginary part");
  const SchemaType<IndexDocument> named{names.description,
                                        [names](const DocumentNode& node) {
                                          IndexDocument index;
                                          index.name = names.read(node);
                                          try {
                                            radiometry::refractive_index(index.name);
                                          } catch (const InputError& error) {
                                            node.fail(error.what());
                                          }
                                          return index;
                                        },
                                        [names](const IndexDocument& index, Writing& writing) -> Written {
                                          if (index.name.empty()) return std::nullopt;
                                          return names.write(index.name, writing);
                                        }};
  const SchemaType<IndexDocument> numbers{
      pair.description,
      [pair](const DocumentNode& node) {
        const std::vector<double> values = pair.read(node);
        return IndexDocument{{}, constant(values[0]), constant(values[1])};
      },
      [pair](const IndexDocument& index, Writing& writing) -> Written {
        const auto value = [](const std::optional<SpectrumDocument>& spectrum) {
          return spectrum ? std::get_if<ConstantSpectrum>(&spectrum->source) : nullptr;
        };
        const ConstantSpectrum *n = value(index.n), *k = value(index.k);
        if (n == nullptr || k == nullptr) return std::nullopt;
        return pair.write({n->value, k->value}, writing);
      }};
  return either(either(named, numbers), record.type());
}

SchemaType<MieDocument> mie_type() {
  Record<MieDocument> record(
      "spheres",
      "Spheres of many sizes, by Mie's theory: numbers that are normal in the logarithm of the radius ('radius', 'sigma'), or a "
      "gamma distribution ('effective_radius', 'variance').");
  record.exactly_one()
      .one("radius", &MieDocument::radius_um, quantity(kWavelength, Range::between(1e-4, 1e3, "um")),
           "median, by number")
      .one("effective_radius", &MieDocument::effective_radius_um,
           quantity(kWavelength, Range::between(1e-3, 1e3, "um")), "mean of the radius weighted with area")
      .optional("sigma", &MieDocument::deviation, number(Range::between(1.01, 5.0)),
                "geometric standard deviation, of 'radius'")
      .optional("variance", &MieDocument::effective_variance, number(Range::between(0.005, 0.33)),
                "of the radius about the effective one, over its square; 0.1 if nothing is said")
      .required(
          "index", &MieDocument::index, index_type(),
          "a name of the built-in table (`ifov materials --indices`), a list of n and k, or spectra of both")
      .needs("sigma", "radius")
      .needs("variance", "effective_radius")
      .check([](const MieDocument& mie, const DocumentNode& node) {
        if (mie.radius_um && !mie.deviation)
          node.given("radius").fail("'radius' needs 'sigma', the geometric standard deviation about it");
      });
  return record.type();
}

/// What haze of the document's own has to be.
void check_own(const AerosolDocument& aerosol, const DocumentNode& node) {
  if (!aerosol.own) return;
  const OwnHazeDocument& haze = *aerosol.own;
  for (const char* key : {"type", "season"})
    if (const DocumentNode* other = node.find(key))
      other->fail_at_key(
          format("'{}' is of the tables' haze, and 'optical_depth' of haze of one's own: leave "
                 "one out",
                 key));
  if (haze.mie) {
    for (const char* key : {"angstrom", "single_scattering_albedo"})
      if (const DocumentNode* other = node.find(key))
        other->fail_at_key(format("'{}' follows from the spheres of 'mie': leave one out", key));
  }
  if (!haze.mie && !haze.angstrom)
    node.given(kDepth).fail("'optical_depth' needs 'angstrom', by which extinction changes with wavelength");
  if (!haze.mie && !haze.single_scattering_albedo)
    node.given(kDepth).fail(
        "'optical_depth' needs 'single_scattering_albedo', the share of extinction that is scattered");
  if (!haze.asymmetry && !haze.phase_function && !haze.mie)
    node.given(kDepth).fail(
        "'optical_depth' needs 'asymmetry', 'phase_function' or 'mie', by which light is scattered");
  if (haze.top_km && *haze.top_km > atmosphere::kTopOfAtmosphereKm)
    node.given("top").fail(format("the haze reaches to {:g} km, above the air, which ends at {:g} km",
                                  *haze.top_km, atmosphere::kTopOfAtmosphereKm));
  if (haze.base_km && *haze.base_km >= haze.top_km.value_or(atmosphere::kTopOfAtmosphereKm))
    node.given("base").fail(format("the haze begins at {:g} km, not below its top at {:g} km", *haze.base_km,
                                   haze.top_km.value_or(atmosphere::kTopOfAtmosphereKm)));
}

}  // namespace

SchemaType<AerosolDocument> aerosol_type() {
  Record<AerosolDocument> record(
      "aerosol",
      "Haze and dust: of the tables (Shettle and Fenn 1979), or with 'optical_depth' of one's own below 10 km.");
  record
      .with_default("type", tables(&AerosolDescription::type), word_type(atmosphere::aerosol_types()),
                    "\"rural\"", "of the lowest 2 km; \"none\": clear air at all heights")
      .at_most_one()
      .one("visibility", tables(&AerosolDescription::visibility_km),
           quantity(kLength, Range::above(0.0, "m"), 1e-3),
           "meteorological range at the ground; 23 km if nothing is said")
      .one("aot550", tables(&AerosolDescription::aot550), number(Range::at_least(0.0)),
           "vertical optical thickness of all aerosol at 550 nm")
      .one(kDepth, own(&OwnHazeDocument::optical_depth), number(Range::between(0.0, 10.0)),
           "vertical, of haze of one's own, at 'wavelength'; the stratosphere's aerosol is beside it")
      .optional("season", tables(&AerosolDescription::season), word_type({"spring-summer", "autumn-winter"}),
                "of the air above 2 km; without it that of the profile")
      .with_default("stratosphere", tables(&AerosolDescription::stratosphere),
                    word_type(atmosphere::stratosphere_states()), "\"background\"",
                    "aerosol from 10 to 30 km; \"none\": none above 10 km")
      .optional("wavelength", own(&OwnHazeDocument::wavelength_um),
                quantity(kWavelength, Range::above(0.0, "um")),
                "of the optical depth; 0.55 um if nothing is said")
      .optional("angstrom", own(&OwnHazeDocument::angstrom), number(Range::between(-5.0, 5.0)),
                "exponent a of extinction, which goes as wavelength^-a")
      .optional("single_scattering_albedo", own(&OwnHazeDocument::single_scattering_albedo),
                spectrum_type(SpectrumOf::fraction), "share of extinction that is scattered")
      .at_most_one()
      .one(
          "asymmetry", own(&OwnHazeDocument::asymmetry), spectrum_type(SpectrumOf::number),
          "mean cosine of the scattering angle, -0.99 to 0.99: scatters by Henyey and Greenstein's function, "
          "without polarization")
      .one("phase_function", own(&OwnHazeDocument::phase_function), file(),
           "[table](phase_functions.md) of angles and wavelengths; scatters without polarization")
      .one("mie", own(&OwnHazeDocument::mie), mie_type(),
           "spheres: what they take, scatter and polarize follows from their sizes and index of refraction")
      .optional("base", own(&OwnHazeDocument::base_km), quantity(kLength, {}, 1e-3),
                "where the haze begins, above mean sea level; the ground if nothing is said")
      .optional("top", own(&OwnHazeDocument::top_km), quantity(kLength, {}, 1e-3),
                "where it ends; the end of the air if nothing is said")
      .optional(
          "scale_height", own(&OwnHazeDocument::scale_height_km),
          quantity(kLength, Range::above(0.0, "m"), 1e-3),
          "over which its density falls to 1/e; without it the haze is uniform up to 'top', and without "
          "that too 2 km")
      .check(check_own);
  for (const char* key : {"wavelength", "angstrom", "single_scattering_albedo", "asymmetry", "phase_function",
                          "mie", "base", "top", "scale_height"})
    record.needs(key, kDepth);
  return record.type();
}

}  // namespace ifov::io
