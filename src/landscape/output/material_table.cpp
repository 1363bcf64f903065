#include "landscape/output/material_table.h"

#include <stdexcept>
#include <string_view>

#include "core/format.h"
#include "landscape/output/library_spectrum.h"
#include "landscape/output/texture_tile.h"

namespace ifov::landscape {
namespace {

/// A material of the generated scenes. `library` and `curve` name a spectrum of the built-in library; without one
/// `table` is the reflectance.
struct Entry {
  std::string_view name, library;
  int curve = 1;
  bool is_leaf = false;  ///< the library has its transmittance too
  int temperature_c = 20;
  std::string_view table = "";
  int last_curve = 0;  ///< curves up to this one, picked from by a texture; 0: one curve
  Grain grain = Grain::turf;
};

// The visible part is the colour, the rest that of painted metal.
constexpr std::string_view kRedPaint =
    R"({"table": {"wavelength": ["0.35 um", "0.55 um", "0.58 um", "0.62 um", "0.7 um", "1 um", "1.6 um", "2.5 um", "5 um", "14 um"],
        "values": [0.05, 0.05, 0.1, 0.42, 0.5, 0.55, 0.4, 0.15, 0.06, 0.06]}})";
constexpr std::string_view kBluePaint =
    R"({"table": {"wavelength": ["0.35 um", "0.45 um", "0.5 um", "0.56 um", "0.68 um", "0.75 um", "1 um", "1.6 um", "2.5 um", "5 um", "14 um"],
        "values": [0.12, 0.24, 0.14, 0.06, 0.05, 0.25, 0.35, 0.3, 0.12, 0.06, 0.06]}})";
constexpr std::string_view kSilverPaint =
    R"({"table": {"wavelength": ["0.35 um", "0.5 um", "1 um", "2.5 um", "5 um", "14 um"], "values": [0.3, 0.38, 0.4, 0.34, 0.12, 0.1]}})";
constexpr std::string_view kBlackPaint =
    R"({"table": {"wavelength": ["0.35 um", "2.5 um", "5 um", "14 um"], "values": [0.045, 0.05, 0.05, 0.06]}})";
constexpr std::string_view kYellowPaint =
    R"({"table": {"wavelength": ["0.35 um", "0.48 um", "0.53 um", "0.6 um", "1 um", "1.7 um", "2.5 um", "5 um", "14 um"],
        "values": [0.06, 0.08, 0.38, 0.52, 0.58, 0.5, 0.25, 0.07, 0.07]}})";
constexpr std::string_view kGreenPaint =
    R"({"table": {"wavelength": ["0.35 um", "0.47 um", "0.53 um", "0.6 um", "0.68 um", "0.75 um", "1 um", "1.7 um", "2.5 um", "5 um", "14 um"],
        "values": [0.05, 0.09, 0.17, 0.09, 0.07, 0.25, 0.32, 0.28, 0.12, 0.06, 0.06]}})";
constexpr std::string_view kCreamPaint =
    R"({"table": {"wavelength": ["0.35 um", "0.42 um", "0.5 um", "0.6 um", "1 um", "1.45 um", "1.9 um", "2.5 um", "5 um", "14 um"],
        "values": [0.1, 0.42, 0.58, 0.68, 0.74, 0.66, 0.52, 0.3, 0.08, 0.07]}})";
constexpr std::string_view kTyre =
    R"({"table": {"wavelength": ["0.35 um", "2.5 um", "14 um"], "values": [0.04, 0.05, 0.06]}})";
// Rough bark of broadleaved trees and of spruce: rising through the visible, dry cellulose beyond.
constexpr std::string_view kBark =
    R"({"table": {"wavelength": ["0.35 um", "0.5 um", "0.7 um", "1 um", "1.3 um", "1.45 um", "1.65 um", "1.93 um", "2.2 um", "2.5 um", "8 um", "14 um"],
        "values": [0.07, 0.11, 0.2, 0.35, 0.42, 0.34, 0.4, 0.24, 0.28, 0.18, 0.06, 0.04]}})";
// Weathered grey by years of rain.
constexpr std::string_view kTimber =
    R"({"table": {"wavelength": ["0.35 um", "0.5 um", "0.7 um", "1 um", "1.3 um", "1.45 um", "1.65 um", "1.93 um", "2.2 um", "2.5 um", "8 um", "14 um"],
        "values": [0.1, 0.17, 0.25, 0.36, 0.42, 0.36, 0.42, 0.28, 0.3, 0.2, 0.06, 0.05]}})";
// Fallen needles of spruce: brown, without chlorophyll, and dry.
constexpr std::string_view kNeedleLitter =
    R"({"table": {"wavelength": ["0.35 um", "0.5 um", "0.6 um", "0.7 um", "0.85 um", "1.1 um", "1.3 um", "1.45 um", "1.65 um", "1.93 um", "2.2 um", "2.5 um", "8 um", "14 um"],
        "values": [0.04, 0.06, 0.1, 0.16, 0.25, 0.34, 0.36, 0.27, 0.32, 0.17, 0.21, 0.13, 0.04, 0.03]}})";
constexpr std::string_view kBirchBark =
    R"({"table": {"wavelength": ["0.35 um", "0.45 um", "0.7 um", "1 um", "1.3 um", "1.45 um", "1.65 um", "1.93 um", "2.2 um", "2.5 um", "8 um", "14 um"],
        "values": [0.25, 0.4, 0.52, 0.6, 0.6, 0.48, 0.52, 0.3, 0.34, 0.22, 0.06, 0.04]}})";

constexpr Entry kEntries[] = {
    // Streets and paths
    {"asphalt, street", "asphalt, street", 1, false, 46, "", 4, Grain::aggregate},
    {"asphalt, repaired", "asphalt, black", 1, false, 49},
    {"asphalt, driveway", "asphalt, road, weathered", 2, false, 47},
    {"concrete, kerb", "concrete, weathered", 1, false, 38},
    {"concrete, pavement", "concrete, pavement", 1, false, 38, "", 3, Grain::slabs},
    {"concrete, driveway", "concrete, pavement", 2, false, 40},
    {"concrete, slab", "concrete, weathered", 2, false, 37},
    {"road paint, white", "roof, white", 1, false, 38},
    {"road paint, yellow", "", 1, false, 41, kYellowPaint},
    // Ground
    {"lawn", "grass, lawn", 1, false, 27, "", 2, Grain::turf},
    {"lawn, sparse", "grass, lawn, sparse", 1, false, 30},
    {"lawn, dry", "grass, dry", 1, false, 35, "", 3, Grain::turf},
    {"meadow", "grass, pasture", 1, false, 26, "", 3, Grain::turf},
    {"clover", "meadow", 1, false, 26, "", 3, Grain::turf},
    {"soil", "soil, bare", 1, false, 40, "", 2, Grain::turf},
    {"soil, dark", "soil, bare", 2, false, 41},
    {"sand", "sand, beach", 1, false, 48},
    {"sand, pale", "soil, playa mud, pale", 1, false, 44},
    {"gravel", "stone, quartzite conglomerate", 1, false, 46},
    {"litter, needles", "", 1, false, 26, kNeedleLitter},
    {"litter, leaves", "leaf, broadleaf, modelled", 6, false, 26},
    {"rock", "stone, granite", 1, false, 34},
    // Houses
    {"roof tile, terracotta", "roof tile, terracotta", 1, false, 48},
    {"roof tile, red", "roof tile, red clay", 1, false, 49, "", 4, Grain::weathering},
    {"roof tile, brown", "roof tile, brown", 1, false, 51},
    {"roof shingle, grey", "roof shingle, asphalt, grey", 1, false, 53},
    {"roof shingle, brown", "roof shingle, asphalt, brown", 1, false, 52},
    {"roof, slate", "roof shingle, slate", 1, false, 50},
    {"roof, bitumen", "roof, bitumen", 1, false, 54},
    {"brick, red", "brick, red", 1, false, 34},
    {"brick, weathered", "brick, red", 2, false, 34},
    {"cinder block", "cinder block", 1, false, 33},
    {"wall paint, white", "roof, white", 1, false, 29},
    {"wall paint, cream", "", 1, false, 30, kCreamPaint},
    {"timber, weathered", "", 1, false, 34, kTimber},
    {"trim, white", "plastic, white", 1, false, 29},
    {"door, green", "metal, painted dark green", 1, false, 34},
    {"door, red", "", 1, false, 35, kRedPaint},
    {"window glass", "glass, window", 1, false, 28},
    // Gardens
    {"water, pool", "water, swimming pool", 1, false, 25},
    {"leaf, oak", "leaf, broadleaf, modelled", 1, true, 25},
    {"leaf, maple", "leaf, aspen", 2, true, 25},
    {"leaf, birch", "leaf, broadleaf, modelled", 2, true, 25},
    {"leaf, spruce", "needle, conifer, modelled", 2, true, 25},
    {"leaf, hedge", "leaf, broadleaf, modelled", 3, true, 26},
    {"leaf, shrub", "leaf, aspen", 1, true, 26},
    {"leaf, desert shrub", "leaf, evergreen shrub, modelled", 1, true, 34},
    {"bark", "", 1, false, 28, kBark},
    {"bark, birch", "", 1, false, 27, kBirchBark},
    // Sports
    {"court, red", "brick, paving", 1, false, 45},
    {"court, green", "", 1, false, 44, kGreenPaint},
    {"court line", "roof, white", 1, false, 39},
    {"net", "", 1, false, 34, kTyre},
    // Vehicles and lines
    {"car paint, white", "roof, white", 1, false, 36},
    {"car paint, silver", "", 1, false, 43, kSilverPaint},
    {"car paint, black", "", 1, false, 56, kBlackPaint},
    {"car paint, red", "", 1, false, 48, kRedPaint},
    {"car paint, blue", "", 1, false, 50, kBluePaint},
    {"car paint, green", "", 1, false, 50, kGreenPaint},
    {"tyre", "", 1, false, 42, kTyre},
    {"steel, galvanised", "steel, galvanised", 1, false, 36},
    {"aluminium", "aluminium, brushed", 1, false, 35},
    {"pole wood", "", 1, false, 35, kTimber},
    {"insulator", "roof tile, brown", 1, false, 34},
    // Harbour
    {"water, harbour", "water, coastal", 1, false, 18},
    {"container paint, red", "", 1, false, 44, kRedPaint},
    {"container paint, blue", "", 1, false, 45, kBluePaint},
    {"container paint, green", "", 1, false, 45, kGreenPaint},
    {"hull paint, black", "", 1, false, 30, kBlackPaint},
    {"hull paint, red", "", 1, false, 24, kRedPaint},
    {"deck paint, green", "", 1, false, 42, kGreenPaint},
    {"crane paint, yellow", "", 1, false, 38, kYellowPaint},
};

std::string spectrum_text(const Entry& entry, SceneFolder& folder) {
  if (entry.library.empty()) return std::string(entry.table);
  if (entry.last_curve == 0) return library_spectrum(entry.library, entry.curve, folder);
  std::string curves;
  for (int curve = entry.curve; curve <= entry.last_curve; ++curve)
    curves += (curves.empty() ? "" : ", ") + library_spectrum(entry.library, curve, folder);
  return "[" + curves + "]";
}

std::string texture_text(const Entry& entry, SceneFolder& folder) {
  const TextureTile tile = texture_tile(entry.grain);
  const std::string file = format("maps/{}.tif", tile.name);
  if (!folder.has(file)) folder.add_map(tile.name, tile.raster);
  return format(
      R"("texture": {{"images": [{{"file": "{}", "low_left": ["0 m", "0 m"], "size": ["{} m", "{} m"],
          "tiling": "repeat", "from": "0.6 um", "to": "0.7 um"}}]}}, )",
      file, tile.size_m, tile.size_m);
}

}  // namespace

std::string material_text(const std::string& name, SceneFolder& folder) {
  for (const Entry& entry : kEntries) {
    if (entry.name != name) continue;
    const std::string spectrum = spectrum_text(entry, folder);
    const std::string transmittance =
        entry.is_leaf
            ? format(R"("transmittance": {}, )",
                     library_spectrum(entry.library, entry.curve, folder, LeafColumn::transmittance))
            : "";
    const std::string texture = entry.last_curve > 0 ? texture_text(entry, folder) : "";
    return format(R"("{}": {{"reflectance": {}, {}{}"temperature": "{} degC"}})", name, spectrum,
                  transmittance, texture, entry.temperature_c);
  }
  throw std::logic_error("no material '" + name + "' in the table of the generated scenes");
}

}  // namespace ifov::landscape
