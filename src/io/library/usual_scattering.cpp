#include "io/library/usual_scattering.h"

#include <algorithm>

namespace ifov::io {
namespace {

constexpr std::string_view kCanopy =
    "leaves and stalks shade each other: brightest with the Sun in one's back. Its weights are of the place (BRDF products of "
    "MODIS); without them a Lambertian surface has at least the reflectance";
constexpr std::string_view kLeaf =
    "light of one leaf leaves both sides much as Lambert's law says; where its wax shines, 'leaf' by its contents";
constexpr std::string_view kSoil =
    "clods and grains are in each other's shadow: rough and matt. 'hapke' takes the albedo of a grain, which these figures are not";
constexpr std::string_view kStone = "rough and matt: facets in grooves";
constexpr std::string_view kPaint =
    "colour under a smooth skin: gloss that is the same at all wavelengths, and polarized";
constexpr std::string_view kDull = "what is left of the gloss is wide, on a base that scatters";
constexpr std::string_view kMetal =
    "the gloss of a metal, which a diffuse measurement leaves out in part; its index takes the place of these figures";
constexpr std::string_view kSheet = R"({"rough_conductor": {"index": "aluminium", "roughness": 0.3}})";
constexpr std::string_view kSea =
    "waves mirror Sun and sky at every angle otherwise; its reflectance is what leaves the water alone, a few percent at most";
constexpr std::string_view kCalm = R"({"smooth": {"index": "water", "over": "absorber"}})";
constexpr std::string_view kGrooves = R"({"oren_nayar": {"slope": "20 deg"}})",
                           kSteep = R"({"oren_nayar": {"slope": "30 deg"}})",
                           kGloss = R"({"rough_dielectric": {"index": 1.5, "roughness": 0.2}})",
                           kSatin = R"({"rough_dielectric": {"index": 1.5, "roughness": 0.4}})";

constexpr UsualScattering kRows[] = {
    {"grass, blades, pile", "oren_nayar", kSteep, "a heap without an upright: rough and matt"},
    {"grass", "ross_li", {}, kCanopy},
    {"meadow", "ross_li", {}, kCanopy},
    {"reed", "ross_li", {}, kCanopy},
    {"crop", "ross_li", {}, kCanopy},
    {"tree crown", "ross_li", {}, kCanopy},
    {"leaves", "oren_nayar", kSteep, "a heap without an upright: rough and matt"},
    {"needles", "oren_nayar", kSteep, "a heap without an upright: rough and matt"},
    {"leaf", "lambertian", R"("lambertian")", kLeaf},
    {"needle", "lambertian", R"("lambertian")", kLeaf},
    {"lichen", "oren_nayar", kSteep, kStone},
    {"sand, wet", "rough_dielectric", R"({"rough_dielectric": {"index": 1.33, "roughness": 0.3}})",
     "a film of water on sand: it shines"},
    {"soil", "oren_nayar", kSteep, kSoil},
    {"sand", "oren_nayar", kGrooves, kSoil},
    {"stone", "oren_nayar", kGrooves, kStone},
    {"water, swimming pool", "smooth", kCalm,
     "calm water mirrors; what its floor sends up has to be a floor below it", true},
    {"water, pure", "smooth", kCalm, "the surface alone, at every angle by Fresnel's equations", true},
    {"water", "sea", {}, kSea},
    {"ice", "rough_conductor", R"({"rough_conductor": {"index": "ice", "roughness": 0.2}})",
     "the surface alone, by its index at every angle", true},
    {"snow", "snow", R"({"snow": {"grain": "1 mm"}})",
     "brighter past the light, and by the size of its grains; of slush these figures are nearer", true},
    {"brick, painted", "rough_dielectric", kSatin, kPaint},
    {"brick", "oren_nayar", kGrooves, kStone},
    {"concrete", "oren_nayar", kGrooves, kStone},
    {"cement", "oren_nayar", kGrooves, kStone},
    {"cinder block", "oren_nayar", kSteep, kStone},
    {"wood, cedar", "oren_nayar", kSteep, kStone},
    {"wood", "rough_dielectric", kSatin, kDull},
    {"glass, window", "slab", R"({"slab": {"n": 1.52, "k": 1e-7, "thickness": "4 mm"}})",
     "a pane lets light through and mirrors at every angle otherwise; n and k of 'glass, soda-lime' by wavelength",
     true},
    {"asphalt, black", "rough_dielectric", kSatin, kDull},
    {"asphalt", "oren_nayar", kSteep, kStone},
    {"plastic, tarpaulin", "rough_dielectric", kSatin, kPaint},
    {"plastic", "rough_dielectric", kGloss, kPaint},
    {"roof tile, black", "rough_dielectric", kSatin, kDull},
    {"roof tile", "oren_nayar", kGrooves, kStone},
    {"roof shingle", "oren_nayar", kSteep, kStone},
    {"roof, tar paper", "oren_nayar", kSteep, kStone},
    {"roof, bitumen", "rough_dielectric", kSatin, kDull},
    {"roof", "rough_dielectric", kGloss, kPaint},
    {"metal, painted", "rough_dielectric", kGloss, kPaint},
    {"aluminium, weathered", "rough_dielectric", kSatin, kDull},
    {"aluminium, polished", "rough_conductor",
     R"({"rough_conductor": {"index": "aluminium", "roughness": 0.05}})", kMetal, true},
    {"aluminium", "rough_conductor", kSheet, kMetal, true},
    {"metal sheet", "rough_conductor", kSheet, kMetal, true},
    {"steel", "rough_conductor", R"({"rough_conductor": {"index": "zinc", "roughness": 0.3}})", kMetal, true},
    {"iron, rusted", "oren_nayar", kSteep, "rust is a powder: rough and matt"},
    {"iron", "rough_dielectric", kSatin, kDull},
    {"lead", "rough_dielectric", kSatin, kDull},
    {"copper", "rough_conductor", R"({"rough_conductor": {"index": "copper", "roughness": 0.05}})", kMetal,
     true},
    {"gold", "rough_conductor", R"({"rough_conductor": {"index": "gold", "roughness": 0.05}})", kMetal, true},
    {"silver", "rough_conductor", R"({"rough_conductor": {"index": "silver", "roughness": 0.05}})", kMetal,
     true},
};

}  // namespace

std::span<const UsualScattering> usual_scattering() { return kRows; }

const UsualScattering* usual_scattering_of(std::string_view material) {
  const auto found = std::find_if(std::begin(kRows), std::end(kRows), [&](const UsualScattering& row) {
    return material.starts_with(row.names);
  });
  return found == std::end(kRows) ? nullptr : &*found;
}

}  // namespace ifov::io
