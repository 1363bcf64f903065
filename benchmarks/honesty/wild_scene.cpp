#include "honesty/wild_scene.h"

#include <array>
#include <fstream>

#include "core/format.h"
#include "honesty/rows_scene.h"
#include "honesty/wild_makers.h"

namespace ifov::benchmarks {

namespace {

using Maker = void (*)(WildDraft&);

constexpr std::array<std::string_view, 30> kKinds{
    "rows_map",   "gaps",   "facade",  "hot_sphere", "mixture", "walls",  "rows_boxes", "ball",
    "wide",       "panels", "texture", "rows_mesh",  "yard",    "lamps",  "colours",    "wires",
    "hemisphere", "blocks", "airy",    "overhead",   "night",   "copies", "holes",      "hot_cells",
    "faces",      "gloss",  "glass",   "water",      "relief",  "street"};
constexpr std::array<Maker, 30> kMakers{
    nullptr,    make_gaps,     make_facade,  make_hot_sphere, make_mixture,    make_walls,
    nullptr,    make_ball,     make_wide,    make_panels,     make_texture,    nullptr,
    make_yard,  make_lamps,    make_colours, make_wires,      make_hemisphere, make_blocks,
    make_airy,  make_overhead, make_night,   make_copies,     make_holes,      make_hot_cells,
    make_faces, make_gloss,    make_glass,   make_water,      make_relief,     make_street};

WildScene rows(RowsScene::Form form, RandomStream& random, const std::string& name,
               const std::filesystem::path& folder) {
  RowsScene made = rows_at_random(form, random.magnitude(0.2, 40.0), random);
  if (random.with(0.35)) made.psf_sigma_px = random.between(0.25, 0.9);
  return {{}, name, made.write(folder, name), made.radiance(), {}};
}

/// Which light a kind is for; the others may have either.
WildDraft::Light light_of(std::string_view kind, RandomStream& random) {
  if (kind == "facade" || kind == "yard" || kind == "ball" || kind == "hemisphere" || kind == "colours" ||
      kind == "airy" || kind == "overhead" || kind == "gloss" || kind == "glass" || kind == "water" ||
      kind == "street")
    return WildDraft::Light::solar;
  if (kind == "hot_sphere" || kind == "lamps" || kind == "mixture" || kind == "wide" || kind == "night" ||
      kind == "hot_cells")
    return WildDraft::Light::thermal;
  return random.with(0.6) ? WildDraft::Light::solar : WildDraft::Light::thermal;
}

}  // namespace

std::span<const std::string_view> wild_kinds() { return kKinds; }

WildScene wild_scene(std::uint64_t number, const std::filesystem::path& folder) {
  const std::size_t kind = number % kKinds.size();
  const std::string name = format("wild_{}_{}", number, kKinds[kind]);
  RandomStream random(number, 0x77696c64);
  WildScene scene;
  if (kMakers[kind] == nullptr) {
    scene = rows(kKinds[kind] == "rows_map"     ? RowsScene::Form::map
                 : kKinds[kind] == "rows_boxes" ? RowsScene::Form::boxes
                                                : RowsScene::Form::mesh,
                 random, name, folder);
  } else {
    WildDraft draft(random, light_of(kKinds[kind], random), name, folder);
    kMakers[kind](draft);
    RandomStream chance(number, 0x6e656172);
    // The photons that tell of sunlight by way of mirrors fall on an orthographic camera.
    if (draft.hints.around_mirrors.empty() && chance.with(0.3)) draft.look_from_near(chance);
    scene = {{}, name, draft.text(std::string(kKinds[kind])), {}, draft.hints};
  }
  scene.kind = kKinds[kind];
  std::ofstream(folder / (name + ".json")) << scene.document;
  return scene;
}

}  // namespace ifov::benchmarks
