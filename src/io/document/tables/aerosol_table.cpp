#include "atmosphere/particles/aerosol_types.h"
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

SchemaType<AeronetDocument> aeronet_type() {
  Record<AeronetDocument> record("AERONET retrieval",
                                 "Haze as an inversion of a Sun photometer's sky radiances tells it.");
  record
      .required("file", &AeronetDocument::file, file(),
                "[inversions](phase_functions.md#aeronet-inversions) of version 3, all products (.all)")
      .optional(
          "phase_functions", &AeronetDocument::phase_functions, file(),
          "phase functions (.pfn); without them the asymmetry scatters by Henyey and Greenstein's function")
      .optional(
          "time", &AeronetDocument::time,
          text_like(
              "^[0-9]{4}-[0-9]{2}-[0-9]{2}(T[0-9]{2}:[0-9]{2}:[0-9]{2}(\\.[0-9]+)?(Z|[+-][0-9]{2}:[0-9]{2}))?$",
              "a time such as \"2019-08-15T21:46:45Z\"", "time of a retrieval"),
          "of the retrieval, \"2019-08-15T21:46:45Z\"; where the file has more than one");
  return record.type();
}

SchemaType<atmosphere::ParticleLayer::Height> height_type() {
  using Height = atmosphere::ParticleLayer::Height;
  Record<Height> record("density at a height", "How dense haze is at one altitude.");
  record.required("altitude", &Height::altitude_km, quantity(kLength, {}, 1e-3), "above mean sea level")
      .required("density", &Height::density, number(Range::at_least(0.0)),
                "in any unit: the optical depth scales it");
  return record.type();
}

/// What haze of the document's own has to be, told at `key`, its depth or its file.
void check_optics(const OwnHazeDocument& haze, const DocumentNode& node) {
  if (haze.aeronet) {
    for (const char* key :
         {"wavelength", "angstrom", "single_scattering_albedo", "asymmetry", "phase_function", "mie", "kind"})
      if (const DocumentNode* other = node.find(key))
        other->fail_at_key(format("'{}' follows from the file of 'aeronet': leave one out", key));
    return;
  }
  if (!haze.optical_depth) return;
  const bool whole = haze.mie || haze.kind;
  if (whole) {
    for (const char* key : {"angstrom", "single_scattering_albedo"})
      if (const DocumentNode* other = node.find(key))
        other->fail_at_key(
            haze.mie ? format("'{}' follows from the spheres of 'mie': leave one out", key)
                     : format("'{}' follows from the 'kind', '{}': leave one out", key, *haze.kind));
    return;
  }
  if (!haze.angstrom)
    node.given(kDepth).fail("'optical_depth' needs 'angstrom', by which extinction changes with wavelength");
  if (!haze.single_scattering_albedo)
    node.given(kDepth).fail(
        "'optical_depth' needs 'single_scattering_albedo', the share of extinction that is scattered");
  if (!haze.asymmetry && !haze.phase_function)
    node.given(kDepth).fail(
        "'optical_depth' needs 'asymmetry', 'phase_function', 'mie' or 'kind', by which light is scattered");
}

void check_heights(const OwnHazeDocument& haze, const DocumentNode& node) {
  if (!haze.heights.empty())
    for (const char* key : {"base", "top", "scale_height"})
      if (const DocumentNode* other = node.find(key))
        other->fail_at_key(format("'{}' and 'heights' both say where the haze is: leave one out", key));
  for (std::size_t k = 0; k < haze.heights.size(); ++k) {
    const double here = haze.heights[k].altitude_km;
    const DocumentNode& altitude = node.given("heights").items()[k].given("altitude");
    if (k > 0 && !(here > haze.heights[k - 1].altitude_km))
      altitude.fail(format("the altitudes of haze must rise: {:g} km follows {:g} km", here,
                           haze.heights[k - 1].altitude_km));
    if (here > atmosphere::kTopOfAtmosphereKm)
      altitude.fail(format("the haze reaches to {:g} km, above the air, which ends at {:g} km", here,
                           atmosphere::kTopOfAtmosphereKm));
  }
  if (haze.top_km && *haze.top_km > atmosphere::kTopOfAtmosphereKm)
    node.given("top").fail(format("the haze reaches to {:g} km, above the air, which ends at {:g} km",
                                  *haze.top_km, atmosphere::kTopOfAtmosphereKm));
  if (haze.base_km && *haze.base_km >= haze.top_km.value_or(atmosphere::kTopOfAtmosphereKm))
    node.given("base").fail(format("the haze begins at {:g} km, not below its top at {:g} km", *haze.base_km,
                                   haze.top_km.value_or(atmosphere::kTopOfAtmosphereKm)));
}

constexpr const char* kHeightKeys[] = {"base", "top", "scale_height", "heights"};

void check_own(const AerosolDocument& aerosol, const DocumentNode& node) {
  const bool file = aerosol.own && aerosol.own->aeronet, mixed = !aerosol.mixture.empty();
  const bool depth = aerosol.own && aerosol.own->optical_depth;
  for (const char* key : {"type", "season"})
    if (const DocumentNode* other = node.find(key); other != nullptr && (depth || file || mixed))
      other->fail_at_key(
          format("'{}' is of the tables' haze, and '{}' of haze of one's own: leave "
                 "one out{}",
                 key,
                 depth  ? kDepth
                 : file ? "aeronet"
                        : "mixture",
                 depth && std::string_view(key) == "type" ? ", or name the type by 'kind'" : ""));
  for (const char* key : kHeightKeys)
    if (const DocumentNode* other = node.find(key); other != nullptr && !depth && !file)
      other->fail_at_key(
          mixed
              ? format("'{}' is of one part of the 'mixture': say it there", key)
              : format(
                    "'{}' needs 'optical_depth' or 'aeronet' beside it: where haze of the tables is, they say",
                    key));
  if (!aerosol.own) return;
  check_optics(*aerosol.own, node);
  check_heights(*aerosol.own, node);
}

/// The keys of haze of one's own but for its depth. `own`: the target of a member.
template <class T, class Own>
void add_optics_and_heights(Record<T>& record, Own own) {
  record
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
      .one("kind", own(&OwnHazeDocument::kind), word_type(atmosphere::aerosol_kinds()),
           "one of the types: optics as 'type' has them, at 'humidity'")
      .optional("humidity", own(&OwnHazeDocument::humidity_percent),
                quantity(kPercent, Range::between(0.0, 100.0, "%"), 100.0),
                "of the air about the particles of the 'kind', which swell in it; 70 % if nothing is said")
      .needs("humidity", "kind")
      .optional("base", own(&OwnHazeDocument::base_km), quantity(kLength, {}, 1e-3),
                "where the haze begins, above mean sea level; the ground if nothing is said")
      .optional("top", own(&OwnHazeDocument::top_km), quantity(kLength, {}, 1e-3),
                "where it ends; the end of the air if nothing is said")
      .optional(
          "scale_height", own(&OwnHazeDocument::scale_height_km),
          quantity(kLength, Range::above(0.0, "m"), 1e-3),
          "over which its density falls to 1/e; without it the haze is uniform up to 'top', and without "
          "that too 2 km")
      .optional("heights", own(&OwnHazeDocument::heights), list(height_type(), 2, 60),
                "in place of these three its density at rising altitudes, linear between and 0 beyond");
}

SchemaType<OwnHazeDocument> part_type() {
  Record<OwnHazeDocument> record("part of a mixture",
                                 "Haze of one kind, with its own depth, optics and heights.");
  record.exactly_one()
      .one(kDepth, &OwnHazeDocument::optical_depth, number(Range::between(0.0, 10.0)),
           "vertical, at 'wavelength'")
      .one("aeronet", &OwnHazeDocument::aeronet, aeronet_type(),
           "a retrieval: depth and all optics from its file");
  add_optics_and_heights(record, [](auto member) { return member; });
  record.check([](const OwnHazeDocument& haze, const DocumentNode& node) {
    check_optics(haze, node);
    check_heights(haze, node);
  });
  return record.type();
}

}  // namespace

SchemaType<AerosolDocument> aerosol_type() {
  Record<AerosolDocument> record(
      "aerosol",
      "Haze and dust: of the tables (Shettle and Fenn 1979; OPAC; smoke), or with 'optical_depth', 'aeronet' or 'mixture' of one's own below 10 km.");
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
      .one("aeronet", own(&OwnHazeDocument::aeronet), aeronet_type(),
           "haze of one's own, by a retrieval: depth and all optics from its file")
      .one("mixture", &AerosolDocument::mixture, list(part_type(), 1, 10),
           "haze of one's own of several kinds, each with its depth, optics and heights")
      .optional("season", tables(&AerosolDescription::season), word_type({"spring-summer", "autumn-winter"}),
                "of the air above 2 km; without it that of the profile")
      .with_default("stratosphere", tables(&AerosolDescription::stratosphere),
                    word_type(atmosphere::stratosphere_states()), "\"background\"",
                    "aerosol from 10 to 30 km; \"none\": none above 10 km");
  add_optics_and_heights(record, [](auto member) { return own(member); });
  record.check(check_own);
  for (const char* key :
       {"wavelength", "angstrom", "single_scattering_albedo", "asymmetry", "phase_function", "mie", "kind"})
    record.needs(key, kDepth);
  return record.type();
}

}  // namespace ifov::io
