#include "materials/bsdf/leaf/leaf.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "materials/bsdf/facet_parameters.h"
#include "materials/bsdf/leaf/prospect.h"
#include "materials/bsdf/leaf/waxed_leaf.h"
#include "materials/bsdf/microfacet/fresnel_rows.h"

namespace ifov::materials {

using radiometry::Spectrum;

namespace {

using Form = BsdfParameter::Form;

std::span<const std::string_view> versions() {
  static constexpr std::array<std::string_view, 3> kWords{"D", "5", "PRO"};
  return kWords;
}

constexpr std::string_view kMatter = "dry_matter", kProteins = "proteins", kCarbon = "carbon",
                           kBeyondBack = "reflectance_beyond", kBeyondThrough = "transmittance_beyond";

/// What the version knows, and no more.
void check_contents(const BsdfInputs& inputs, ProspectVersion version) {
  const std::string& word = inputs.word("version");
  const bool pro = version == ProspectVersion::pro;
  for (const std::string_view key : {kMatter, kProteins, kCarbon}) {
    const bool wanted = (key == kMatter) != pro;
    if (inputs.has(key) == wanted || (wanted && key == kMatter)) continue;
    throw InputError(
        wanted
            ? format(
                  "'{}' is missing: version {} of PROSPECT needs 'proteins' and 'carbon', such as 0.001 and 0.008",
                  key, word)
            : format("version {} of PROSPECT has no '{}', but {}", word, key,
                     pro ? "'proteins' and 'carbon'" : "'dry_matter'"));
  }
  if (version == ProspectVersion::five && inputs.number("anthocyanins") > 0.0)
    throw InputError("version 5 of PROSPECT has no 'anthocyanins'; version D does");
}

LeafContents contents_of(const BsdfInputs& inputs) {
  LeafContents leaf;
  leaf.layers = inputs.number("layers");
  leaf.chlorophyll = inputs.number("chlorophyll");
  leaf.carotenoids = inputs.number("carotenoids");
  leaf.anthocyanins = inputs.number("anthocyanins");
  leaf.brown = inputs.number("brown");
  leaf.water = inputs.number("water");
  // As the other defaults, those of the example of PROSAIL 5B.
  constexpr double kUsualMatter = 0.009;
  leaf.dry_matter = inputs.has(kMatter) ? inputs.number(kMatter) : kUsualMatter;
  if (inputs.has(kProteins)) leaf.proteins = inputs.number(kProteins);
  if (inputs.has(kCarbon)) leaf.carbon = inputs.number(kCarbon);
  return leaf;
}

std::shared_ptr<const Bsdf> leaf_of(const BsdfInputs& inputs) {
  const std::string& word = inputs.word("version");
  const ProspectVersion version = word == "5"     ? ProspectVersion::five
                                  : word == "PRO" ? ProspectVersion::pro
                                                  : ProspectVersion::d;
  check_contents(inputs, version);
  LeafOptics leaf = prospect(version, contents_of(inputs));
  if (inputs.has(kBeyondBack) != inputs.has(kBeyondThrough))
    throw InputError(format(
        "'{}' is missing: beyond what PROSPECT knows, 0.4 to 2.5 um, a leaf needs both its reflectance and its "
        "transmittance",
        inputs.has(kBeyondBack) ? kBeyondThrough : kBeyondBack));
  if (inputs.has(kBeyondBack)) {
    leaf.reflectance = radiometry::continued(leaf.reflectance, inputs.spectrum(kBeyondBack));
    leaf.transmittance = radiometry::continued(leaf.transmittance, inputs.spectrum(kBeyondThrough));
    leaf.surface = leaf.surface.with_outside(radiometry::OutsideRange::extend);
  }
  const Spectrum& factor = inputs.reflectance;
  const auto times = [&](const Spectrum& share) {
    const Spectrum both[] = {share, factor};
    return combined(both, [](std::span<const double> v) { return v[0] * v[1]; });
  };
  if (!inputs.has("wax_roughness"))
    return std::make_shared<Leaf>(times(leaf.reflectance), times(leaf.transmittance));
  const auto inner = [&](const Spectrum& share, bool less_surface) {
    const Spectrum three[] = {share, leaf.surface, factor};
    return combined(three, [&](std::span<const double> v) {
      return v[2] * std::max(0.0, v[0] - (less_surface ? v[1] : 0.0)) / (1.0 - v[1]);
    });
  };
  return std::make_shared<WaxedLeaf>(inputs.spectrum("wax_index"),
                                     facet_width(inputs, "wax_roughness", false),
                                     inner(leaf.reflectance, true), inner(leaf.transmittance, false));
}

}  // namespace

const BsdfModel Leaf::kModel{
    "leaf",
    "a leaf by what it is made of (PROSPECT-5, -D and -PRO), which reflects and transmits, 0.4 to 2.5 um; the reflectance is a factor on "
    "both, 1 as modelled",
    {{"version", "of PROSPECT: `D` (Feret et al. 2017), `5` (2008), without anthocyanins, or `PRO` (2021)",
      Form::word, 0.0, 0.0, "\"D\"", false, versions},
     {"layers", "N: compact layers of cells; 1 to 1.5 of grasses, 1.5 to 2.5 of broad leaves", Form::number,
      1.0, 5.0, "1.5"},
     {"chlorophyll", "a and b, ug/cm2", Form::number, 0.0, 150.0, "40"},
     {"carotenoids", "ug/cm2", Form::number, 0.0, 50.0, "8"},
     {"anthocyanins", "ug/cm2", Form::number, 0.0, 60.0, "0"},
     {"brown", "brown pigments, arbitrary units", Form::number, 0.0, 8.0, "0"},
     {"water", "equivalent thickness, cm", Form::number, 0.0, 0.2, "0.01"},
     {kMatter,
      "dry matter, g/cm2; of versions D and 5, 0.009 unless given",
      Form::number,
      0.0,
      0.1,
      {},
      true},
     {kProteins, "g/cm2; of version PRO", Form::number, 0.0, 0.02, {}, true},
     {kCarbon,
      "carbon-based constituents that are no proteins, g/cm2; of version PRO",
      Form::number,
      0.0,
      0.1,
      {},
      true},
     {"wax_roughness",
      "width of the slopes of a layer of wax (GGX), which shines in place of the surface that PROSPECT has",
      Form::number,
      0.0,
      1.0,
      {},
      true},
     {"wax_index", "its refractive index", Form::spectrum, 1.0, 10.0, "1.45"},
     {kBeyondBack, "of the leaf where PROSPECT knows none", Form::spectrum, 0.0, 1.0, {}, true},
     {kBeyondThrough, "of the leaf where PROSPECT knows none", Form::spectrum, 0.0, 1.0, {}, true}},
    leaf_of,
    true};

Leaf::Leaf(Spectrum reflectance, Spectrum transmittance)
    : spectra_{std::move(reflectance), std::move(transmittance)} {}

void Leaf::evaluate(const BsdfEvent& event, ParameterSpectra parameters, std::size_t count,
                    float* bsdf) const {
  const float* __restrict share = parameters[event.side == Side::reflected ? 0 : 1];
  for (std::size_t n = 0; n < count; ++n) bsdf[n] = share[n] * static_cast<float>(std::numbers::inv_pi);
}

}  // namespace ifov::materials
