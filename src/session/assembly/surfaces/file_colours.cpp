#include "session/assembly/surfaces/file_colours.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "io/document/file_materials_document.h"
#include "io/mesh/mesh_materials.h"
#include "io/raster/picture.h"
#include "materials/colour_image.h"
#include "materials/draped_map.h"
#include "materials/opacity_map.h"
#include "radiometry/colour/upsampling.h"
#include "scene/colour_pattern.h"
#include "scene/scene.h"
#include "session/assembly/shared/spectrum_assembly.h"

namespace ifov::session {
namespace {

using radiometry::LinearRgb;

std::string short_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

materials::Tiling tiling_of_wrap(io::Wrap wrap) {
  switch (wrap) {
    case io::Wrap::repeat: return materials::Tiling::repeat;
    case io::Wrap::mirror: return materials::Tiling::mirror;
    case io::Wrap::edge: return materials::Tiling::edge;
  }
  return materials::Tiling::edge;
}

materials::MapGrid picture_grid(const io::Picture* picture, const std::array<io::Wrap, 2>& wrap) {
  materials::MapGrid grid;
  const int width = picture != nullptr ? picture->width : 1,
            height = picture != nullptr ? picture->height : 1;
  grid.width = width;
  grid.height = height;
  grid.by = materials::MapBy::texture_coordinates;
  grid.north_m = 1.0;
  grid.cell_width_m = 1.0 / width;
  grid.cell_height_m = 1.0 / height;
  grid.tiling = tiling_of_wrap(wrap[0]);
  grid.tiling_down = tiling_of_wrap(wrap[1]);
  return grid;
}

/// Linear colours of a picture's codes under a material's factor.
class Decoded {
 public:
  explicit Decoded(const io::FileMaterial& material) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t code = 0; code < 256; ++code)
        values_[c][code] = material.colour[c] * radiometry::srgb_decoded(static_cast<double>(code) / 255.0);
  }
  LinearRgb of(std::uint32_t rgba) const {
    return {values_[0][rgba & 255u], values_[1][rgba >> 8 & 255u], values_[2][rgba >> 16 & 255u]};
  }

 private:
  std::array<std::array<double, 256>, 3> values_{};
};

constexpr std::uint32_t kColourBits = 0xffffffu;

/// The colours that occur, each once, and how often.
std::map<std::uint32_t, std::size_t> colours_of(const std::vector<std::uint32_t>& cells) {
  std::vector<std::uint32_t> sorted;
  sorted.reserve(cells.size());
  for (const std::uint32_t cell : cells) sorted.push_back(cell & kColourBits);
  std::sort(sorted.begin(), sorted.end());
  std::map<std::uint32_t, std::size_t> counts;
  for (std::size_t k = 0; k < sorted.size();) {
    std::size_t end = k;
    while (end < sorted.size() && sorted[end] == sorted[k]) ++end;
    counts.emplace_hint(counts.end(), sorted[k], end - k);
    k = end;
  }
  return counts;
}

/// From which opacity on a cell is there.
double least_opacity(const io::FileMaterial& material) {
  return material.alpha == io::AlphaMode::mask ? material.alpha_cutoff : 0.5;
}

/// The share of a material that lets a part of the light through, which its holes cannot say.
std::string said_of_alpha(const io::FileMaterial& material) {
  if (material.alpha != io::AlphaMode::blend) return {};
  constexpr double kAlike = 1.0 / 255.0;  // one step of a picture
  const auto in_part = [&](double opacity) { return opacity > kAlike && opacity < 1.0 - kAlike; };
  double share = in_part(material.opacity) ? 1.0 : 0.0;
  if (material.opacity_picture) {
    std::size_t count = 0;
    for (const std::uint32_t cell : material.opacity_picture->cells)
      count += in_part(material.opacity * static_cast<double>(cell >> 24) / 255.0);
    share = static_cast<double>(count) / static_cast<double>(material.opacity_picture->cells.size());
  }
  if (share == 0.0) return {};
  return format(
      "{:.3g} % of it is transparent in part in the file (BLEND), which is not rendered: where less than half of "
      "the light is held back it is cut out, elsewhere opaque",
      100.0 * share);
}

/// `within` where colours tell, `beyond` elsewhere.
radiometry::Spectrum with_beyond(const radiometry::ColourSpectrum& colour, const radiometry::Spectrum& beyond,
                                 const std::string& name) {
  const std::span<const double> um = radiometry::colour_wavelengths_um();
  std::vector<double> values;
  for (const double at : um) values.push_back(colour.at(at));
  return radiometry::continued(
      {{um.begin(), um.end()}, std::move(values), radiometry::OutsideRange::error, name}, beyond);
}

}  // namespace

FileColours::FileColours(const io::DocumentSources& sources, scene::Scene& scene, LogSink* log)
    : sources_(sources), scene_(scene), log_(log) {}
FileColours::~FileColours() = default;

const io::MeshMaterials& FileColours::file(const std::string& path) {
  std::unique_ptr<const io::MeshMaterials>& known = files_[path];
  if (!known) known = std::make_unique<const io::MeshMaterials>(io::read_mesh_materials(path, log_));
  return *known;
}

const io::FileMaterial& FileColours::material(const MeshSlot& slot) {
  const io::MeshMaterials& all = file(slot.file);
  const auto found = std::ranges::find(all.materials, slot.name, &io::FileMaterial::slot);
  if (found == all.materials.end()) {
    std::string known;
    for (const io::FileMaterial& one : all.materials) known += (known.empty() ? "'" : ", '") + one.slot + "'";
    throw InputError(format(
        "'{}' says no colour of the slot '{}' of the mesh (it has {}): give that a material of the document in the "
        "'slots' of 'from_file'",
        all.source, slot.name, known.empty() ? "none" : known));
  }
  if ((found->picture || found->opacity_picture) && slot.without_uv > 0)
    throw InputError(format(
        "the slot '{}' of '{}' has the picture '{}', but {} of its triangles have no texture coordinates: it cannot "
        "be told where it lies. Give the slot a material of the document in the 'slots' of 'from_file'",
        slot.name, short_name(slot.file), found->picture ? found->picture_name : found->opacity_name,
        slot.without_uv));
  return *found;
}

std::shared_ptr<const materials::ColourImage> FileColours::image(const io::FileMaterial& material) {
  auto& known = images_[{material.picture.get(), static_cast<int>(material.wrap[0]),
                         static_cast<int>(material.wrap[1])}];
  if (!known)
    known = std::make_shared<const materials::ColourImage>(
        picture_grid(material.picture.get(), material.wrap), material.picture->cells);
  return known;
}

std::shared_ptr<const materials::OpacityMap> FileColours::holes(const MeshSlot& slot) {
  const auto [known, is_new] = holes_.try_emplace(slot.file + "|" + slot.name);
  if (!is_new) return known->second;
  const io::FileMaterial& written = material(slot);
  if (written.alpha == io::AlphaMode::opaque) return nullptr;
  const double least = least_opacity(written);
  std::vector<bool> open;
  if (written.opacity_picture)
    for (const std::uint32_t cell : written.opacity_picture->cells)
      open.push_back(written.opacity * static_cast<double>(cell >> 24) / 255.0 < least);
  else
    open.push_back(written.opacity < least);
  if (std::find(open.begin(), open.end(), true) == open.end()) return nullptr;
  known->second = std::make_shared<const materials::OpacityMap>(
      picture_grid(written.opacity_picture.get(), written.opacity_wrap), std::move(open));
  return known->second;
}

std::uint32_t FileColours::add_material(const std::string& name, const LinearRgb& colour,
                                        const radiometry::Spectrum* beyond,
                                        std::optional<std::uint32_t> curve_of, double fixed_k) {
  materials::Material material;
  material.name = name;
  const radiometry::ColourSpectrum made = radiometry::upsampled(colour);
  material.reflectance = beyond != nullptr ? with_beyond(made, *beyond, name) : made.spectrum(name);
  if (fixed_k > 0.0) material.temperature_k = fixed_k;
  material.curve_of = curve_of;
  materials::check(material);
  scene_.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

ColourGuess& FileColours::guess_of(const io::FileMaterials& source, const MeshSlot& slot) {
  const std::string name = short_name(slot.file);
  auto found = std::ranges::find_if(guesses_, [&](const ColourGuess& guess) {
    return guess.file == name && guess.beyond == source.beyond.has_value();
  });
  if (found == guesses_.end())
    found = guesses_.insert(guesses_.end(), ColourGuess{name, {}, false, {}, source.beyond.has_value()});
  return *found;
}

void FileColours::note(const io::FileMaterials& source, const MeshSlot& slot, bool emits) {
  ColourGuess& guess = guess_of(source, slot);
  guess.emits = guess.emits || emits;
  if (std::ranges::find(guess.slots, slot.name) == guess.slots.end()) guess.slots.push_back(slot.name);
}

void FileColours::say(const MeshSlot& slot, const io::FileMaterial& material, const std::string& more) {
  const std::string key = slot.file + "|" + slot.name;
  if (log_ == nullptr || std::ranges::find(said_, key) != said_.end()) return;
  said_.push_back(key);
  const std::string of = format("'{}' of '{}'", slot.name, short_name(slot.file));
  if (const std::string hidden = said_of_alpha(material); !hidden.empty())
    log_->warn(format("{}: {}", of, hidden));
  std::string not_used;
  for (const std::string& one : material.not_used) not_used += (not_used.empty() ? "" : ", ") + one;
  if (!not_used.empty())
    log_->warn(format("{}: {} of the file not used: it scatters as Lambert's law says", of, not_used));
  if (!more.empty()) log_->warn(format("{}: {}", of, more));
  if (!file(slot.file).says_coding && material.colour != std::array<double, 3>{1.0, 1.0, 1.0})
    log_->info(format(
        "{}: its Kd is taken in proportion to light (the format does not say whether it is, or coded as pictures are)",
        of));
}

FileColours::Surface FileColours::upsampled(const io::FileMaterials& source, const MeshSlot& slot,
                                            double fixed_k, bool mapped_k) {
  note(source, slot, fixed_k > 0.0 || mapped_k);
  std::shared_ptr<const radiometry::Spectrum>& beyond = beyond_[&source];
  if (source.beyond && !beyond)
    beyond = std::make_shared<const radiometry::Spectrum>(
        assemble_spectrum(sources_, *source.beyond, "reflectance_beyond"));
  const std::string key =
      format("{}|{}|{}|{}", slot.file, slot.name, fixed_k,
             source.beyond ? format("{}", static_cast<const void*>(&source)) : std::string());
  const auto known = surfaces_.find(key);
  const io::FileMaterial& written = material(slot);
  if (known != surfaces_.end()) return known->second;
  const std::string name =
      slot.name.empty() ? short_name(slot.file) : format("{} ({})", slot.name, short_name(slot.file));
  const auto state_of = [&](std::uint32_t material) {
    scene::SurfaceState state;
    state.material = material;
    state.temperature_k = fixed_k;
    scene_.states.push_back(state);
    return static_cast<std::uint32_t>(scene_.states.size() - 1);
  };
  Surface surface;
  if (!written.picture) {
    surface.state = state_of(add_material(name, written.colour, beyond.get(), std::nullopt, fixed_k));
    const bool white = std::ranges::all_of(written.colour, [](double value) { return value == 1.0; });
    say(slot, written, white ? "the file gives it no colour but white: it reflects all light" : "");
    return surfaces_.emplace(key, surface).first->second;
  }
  const Decoded decoded(written);
  const auto lattice = std::make_shared<const materials::ColourLattice>(written.colour);
  const std::map<std::uint32_t, std::size_t> colours = colours_of(written.picture->cells);
  LinearRgb mean{};
  std::vector<bool> used(materials::ColourLattice::kCorners, false);
  for (const auto& [colour, count] : colours) {
    const LinearRgb linear = decoded.of(colour);
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += linear[c] * static_cast<double>(count) / static_cast<double>(written.picture->cells.size());
    const materials::ColourLattice::Mix mix = lattice->mix(colour);
    for (std::size_t k = 0; k < mix.count; ++k) used[mix.parts[k].corner] = true;
  }
  const std::uint32_t base = add_material(name, mean, beyond.get(), std::nullopt, fixed_k);
  surface.state = state_of(base);
  std::vector<scene::ColourPattern::Member> members(used.size(), {surface.state, base});
  for (std::uint32_t corner = 0; corner < used.size(); ++corner) {
    if (!used[corner]) continue;
    const std::uint32_t made =
        add_material(name, materials::ColourLattice::colour(corner), beyond.get(), base, fixed_k);
    members[corner] = {state_of(made), made};
    guess_of(source, slot).corners.push_back(made);
  }
  surface.pattern = std::make_shared<const scene::ColourPattern>(image(written), lattice, surface.state,
                                                                 std::move(members));
  say(slot, written, "");
  return surfaces_.emplace(key, surface).first->second;
}

std::shared_ptr<const materials::ClassMap> FileColours::classes(const io::FileMaterials& source,
                                                                const MeshSlot& slot) {
  const io::FileMaterial& written = material(slot);
  const std::string key = format("{}|{}|{}", slot.file, slot.name, static_cast<const void*>(&source));
  std::shared_ptr<const materials::ClassMap>& known = classes_[key];
  if (known) return known;
  std::vector<std::array<double, 3>> wanted;
  for (const io::FileMaterials::Colour& colour : source.colours) {
    LinearRgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = radiometry::srgb_decoded(colour.srgb[c] / 255.0);
    wanted.push_back(radiometry::cielab(radiometry::tristimulus_of(rgb)));
  }
  double farthest = 0.0;
  std::size_t far = 0;
  const auto nearest = [&](const LinearRgb& rgb, std::size_t count) {
    constexpr double kFar = 10.0;
    const std::array<double, 3> lab = radiometry::cielab(radiometry::tristimulus_of(rgb));
    std::size_t best = 0;
    double least = 0.0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const double away = std::hypot(lab[0] - wanted[k][0], lab[1] - wanted[k][1], lab[2] - wanted[k][2]);
      if (k == 0 || away < least) best = k, least = away;
    }
    farthest = std::max(farthest, least);
    if (least > kFar) far += count;
    return static_cast<std::uint16_t>(best);
  };
  std::vector<std::uint16_t> numbers;
  if (!written.picture) {
    numbers.push_back(nearest(written.colour, 1));
  } else {
    const Decoded decoded(written);
    std::map<std::uint32_t, std::uint16_t> of;
    for (const auto& [colour, count] : colours_of(written.picture->cells))
      of.emplace_hint(of.end(), colour, nearest(decoded.of(colour), count));
    numbers.reserve(written.picture->cells.size());
    for (const std::uint32_t cell : written.picture->cells) numbers.push_back(of.at(cell & kColourBits));
  }
  std::string more;
  if (far > 0)
    more = format(
        "{:.3g} % of its cells look unlike every colour that is given (by more than 10 in CIELAB, up to {:.0f}); "
        "they take the nearest, which is a guess",
        100.0 * static_cast<double>(far) / static_cast<double>(numbers.size()), farthest);
  say(slot, written, more);
  known = std::make_shared<const materials::ClassMap>(picture_grid(written.picture.get(), written.wrap),
                                                      std::move(numbers));
  return known;
}

}  // namespace ifov::session
