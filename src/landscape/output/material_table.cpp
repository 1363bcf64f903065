#include "landscape/output/material_table.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/format.h"
#include "landscape/output/library_spectrum.h"
#include "landscape/output/texture_tile.h"

namespace ifov::landscape {
namespace {

constexpr double kZero_k = 273.15;  // of 0 degC

/// Wavelength in micrometres, and reflectance.
using Row = std::pair<double, double>;

/// A material of the generated scenes. `library` and `curve` name a spectrum of the built-in library; without one
/// `table` is the reflectance.
struct Entry {
  std::string_view name, library;
  int curve = 1;
  bool is_leaf = false;  ///< the library has its transmittance too
  int temperature_c = 20;
  std::span<const Row> table = {};
  int last_curve = 0;  ///< curves up to this one, picked from by a texture; 0: one curve
  Grain grain = Grain::turf;
};

// The visible part is the colour, the rest that of painted metal.
constexpr Row kRedPaint[] = {{0.35, 0.05}, {0.55, 0.05}, {0.58, 0.1}, {0.62, 0.42}, {0.7, 0.5},
                             {1, 0.55},    {1.6, 0.4},   {2.5, 0.15}, {5, 0.06},    {14, 0.06}};
constexpr Row kBluePaint[] = {{0.35, 0.12}, {0.45, 0.24}, {0.5, 0.14}, {0.56, 0.06},
                              {0.68, 0.05}, {0.75, 0.25}, {1, 0.35},   {1.6, 0.3},
                              {2.5, 0.12},  {5, 0.06},    {14, 0.06}};
constexpr Row kSilverPaint[] = {{0.35, 0.3}, {0.5, 0.38}, {1, 0.4}, {2.5, 0.34}, {5, 0.12}, {14, 0.1}};
constexpr Row kBlackPaint[] = {{0.35, 0.045}, {2.5, 0.05}, {5, 0.05}, {14, 0.06}};
constexpr Row kYellowPaint[] = {{0.35, 0.06}, {0.48, 0.08}, {0.53, 0.38}, {0.6, 0.52}, {1, 0.58},
                                {1.7, 0.5},   {2.5, 0.25},  {5, 0.07},    {14, 0.07}};
constexpr Row kGreenPaint[] = {{0.35, 0.05}, {0.47, 0.09}, {0.53, 0.17}, {0.6, 0.09},
                               {0.68, 0.07}, {0.75, 0.25}, {1, 0.32},    {1.7, 0.28},
                               {2.5, 0.12},  {5, 0.06},    {14, 0.06}};
constexpr Row kCreamPaint[] = {{0.35, 0.1},  {0.42, 0.42}, {0.5, 0.58}, {0.6, 0.68}, {1, 0.74},
                               {1.45, 0.66}, {1.9, 0.52},  {2.5, 0.3},  {5, 0.08},   {14, 0.07}};
constexpr Row kTyre[] = {{0.35, 0.04}, {2.5, 0.05}, {14, 0.06}};
// Rough bark of broadleaved trees and of spruce: rising through the visible, dry cellulose beyond.
constexpr Row kBark[] = {{0.35, 0.07}, {0.5, 0.11},  {0.7, 0.2},  {1, 0.35},   {1.3, 0.42}, {1.45, 0.34},
                         {1.65, 0.4},  {1.93, 0.24}, {2.2, 0.28}, {2.5, 0.18}, {8, 0.06},   {14, 0.04}};
// Weathered grey by years of rain.
constexpr Row kTimber[] = {{0.35, 0.1},  {0.5, 0.17},  {0.7, 0.25}, {1, 0.36},  {1.3, 0.42}, {1.45, 0.36},
                           {1.65, 0.42}, {1.93, 0.28}, {2.2, 0.3},  {2.5, 0.2}, {8, 0.06},   {14, 0.05}};
// Fallen needles of spruce: brown, without chlorophyll, and dry.
constexpr Row kNeedleLitter[] = {{0.35, 0.04}, {0.5, 0.06}, {0.6, 0.1},   {0.7, 0.16},  {0.85, 0.25},
                                 {1.1, 0.34},  {1.3, 0.36}, {1.45, 0.27}, {1.65, 0.32}, {1.93, 0.17},
                                 {2.2, 0.21},  {2.5, 0.13}, {8, 0.04},    {14, 0.03}};
constexpr Row kBirchBark[] = {{0.35, 0.25}, {0.45, 0.4}, {0.7, 0.52}, {1, 0.6},    {1.3, 0.6}, {1.45, 0.48},
                              {1.65, 0.52}, {1.93, 0.3}, {2.2, 0.34}, {2.5, 0.22}, {8, 0.06},  {14, 0.04}};

constexpr Entry kEntries[] = {
    // Streets and paths
    {"asphalt, street", "asphalt, street", 1, false, 46, {}, 4, Grain::aggregate},
    {"asphalt, repaired", "asphalt, black", 1, false, 49},
    {"asphalt, driveway", "asphalt, road, weathered", 2, false, 47},
    {"concrete, kerb", "concrete, weathered", 1, false, 38},
    {"concrete, pavement", "concrete, pavement", 1, false, 38, {}, 3, Grain::slabs},
    {"concrete, driveway", "concrete, pavement", 2, false, 40},
    {"concrete, slab", "concrete, weathered", 2, false, 37},
    {"road paint, white", "roof, white", 1, false, 38},
    {"road paint, yellow", "", 1, false, 41, kYellowPaint},
    // Ground
    {"lawn", "grass, lawn", 1, false, 27, {}, 2, Grain::turf},
    {"lawn, sparse", "grass, lawn, sparse", 1, false, 30},
    {"lawn, dry", "grass, dry", 1, false, 35, {}, 3, Grain::turf},
    {"meadow", "grass, pasture", 1, false, 26, {}, 3, Grain::turf},
    {"clover", "meadow", 1, false, 26, {}, 3, Grain::turf},
    {"soil", "soil, bare", 1, false, 40, {}, 2, Grain::turf},
    {"soil, dark", "soil, bare", 2, false, 41},
    {"sand", "sand, beach", 1, false, 48},
    {"sand, pale", "soil, playa mud, pale", 1, false, 44},
    {"gravel", "stone, quartzite conglomerate", 1, false, 46},
    {"litter, needles", "", 1, false, 26, kNeedleLitter},
    {"litter, leaves", "leaf, broadleaf, modelled", 6, false, 26},
    {"rock", "stone, granite", 1, false, 34},
    // Houses
    {"roof tile, terracotta", "roof tile, terracotta", 1, false, 48},
    {"roof tile, red", "roof tile, red clay", 1, false, 49, {}, 4, Grain::weathering},
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

std::vector<io::SpectrumDocument> curves_of(const Entry& entry, SceneFolder& folder) {
  std::vector<io::SpectrumDocument> curves;
  if (entry.library.empty()) {
    io::TableSpectrum table;
    for (const auto& [wavelength_um, reflectance] : entry.table) {
      table.wavelength_um.push_back(wavelength_um);
      table.values.push_back(reflectance);
    }
    curves.emplace_back().source = std::move(table);
  } else {
    for (int curve = entry.curve; curve <= std::max(entry.curve, entry.last_curve); ++curve)
      curves.push_back(library_spectrum(entry.library, curve, folder));
  }
  return curves;
}

io::TextureDocument texture_of(const Entry& entry, SceneFolder& folder) {
  const TextureTile tile = texture_tile(entry.grain);
  io::TextureImage image;
  image.raster.file.path = format("maps/{}.tif", tile.name);
  if (!folder.has(image.raster.file.path)) folder.add_map(tile.name, tile.raster);
  image.raster.placement = io::RasterDocument::Placement{0.0, 0.0, tile.size_m, tile.size_m};
  image.raster.tiling = io::Tiling::repeat;
  image.from_um = 0.6;
  image.to_um = 0.7;
  return {{image}, false, {}};
}

}  // namespace

io::MaterialDocument table_material(const std::string& name, SceneFolder& folder) {
  for (const Entry& entry : kEntries) {
    if (entry.name != name) continue;
    io::MaterialDocument material;
    material.name = name;
    std::vector<io::SpectrumDocument> curves = curves_of(entry, folder);
    material.spectrum = std::move(curves.front());
    material.further_curves.assign(curves.begin() + 1, curves.end());
    if (entry.is_leaf)
      material.transmittance =
          library_spectrum(entry.library, entry.curve, folder, LeafColumn::transmittance);
    if (entry.last_curve > 0) material.texture = texture_of(entry, folder);
    material.temperature = io::TemperatureDocument{entry.temperature_c + kZero_k, {}};
    return material;
  }
  throw std::logic_error("no material '" + name + "' in the table of the generated scenes");
}

}  // namespace ifov::landscape
