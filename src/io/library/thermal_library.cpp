#include "io/library/thermal_library.h"

#include <algorithm>

#include "core/error.h"
#include "core/names.h"
#include "io/tables/text_table.h"

namespace ifov::data {
extern const std::string_view thermal_materials_txt;
}

namespace ifov::io {
namespace {

/// Reads a table line by line; a surface's keys hold for all names that it was begun with.
class ThermalTable {
 public:
  explicit ThermalTable(const TextFile& file) : file_(file) {}

  void read() {
    for (line_ = 1; line_ <= file_.line_count(); ++line_) {
      const std::string_view text = file_.line(line_);
      if (is_blank(text) || text[0] == '#') continue;
      const std::size_t colon = text.find(": ");
      if (colon == std::string_view::npos) fail("expected 'key: value'");
      take(text.substr(0, colon), text.substr(colon + 2));
    }
  }

  std::vector<LibrarySolid> solids;
  std::map<std::string, LibrarySurface, std::less<>> surfaces;

 private:
  [[noreturn]] void fail(const std::string& message) const { file_.fail(line_, 0, message); }

  void take(std::string_view key, std::string_view value) {
    if (key == "origin") {
      const std::size_t space = value.find(' ');
      if (space == std::string_view::npos) fail("expected a name and a text");
      origins_[std::string(value.substr(0, space))] = value.substr(space + 1);
    } else if (key == "solid") {
      solids.emplace_back().name = value;
    } else if (key == "about") {
      solid().about = value;
    } else if (key == "source") {
      const auto found = origins_.find(value);
      if (found == origins_.end()) fail(format("no 'origin' is called '{}'", value));
      solid().source = found->second;
    } else if (key == "values") {
      const std::vector<double> numbers = positive(value, 3, true);
      solid().values = {0.0, numbers[0], numbers[1], numbers[2]};
    } else if (key == "melts") {
      solid().melts_k = positive(value, 1, true)[0];
    } else if (key == "surface") {
      current_.clear();
      for (const Field& name : split(value, ';'))
        if (!surfaces.emplace(lower_case(name.text), LibrarySurface{}).second)
          fail(format("'{}' is there twice", name.text));
        else
          current_.push_back(lower_case(name.text));
    } else {
      take_of_surface(key, value);
    }
  }

  void take_of_surface(std::string_view key, std::string_view value) {
    LibrarySurface read;
    if (current_.empty()) fail(format("found the key '{}' and no 'surface' above", key));
    read = surfaces.find(current_.front())->second;
    if (key == "layers") {
      for (const Field& layer : split(value, ';')) {
        if (read.layers.empty()) read.melts_k = solid_of(layer.text).melts_k;
        read.layers.push_back(layer_of(layer.text));
      }
    } else if (key == "back") {
      using Back = LibrarySurface::Back;
      read.back = value == "ground"      ? Back::ground
                  : value == "room"      ? Back::room
                  : value == "insulated" ? Back::insulated
                                         : (fail("expected ground, insulated or room"), Back::ground);
    } else if (key == "leaf") {
      const std::vector<double> numbers = positive(value, 3, false);
      if (!(numbers[0] > 0.0) || (numbers[2] != 1.0 && numbers[2] != 2.0))
        fail("expected a width above 0 m, a conductance and 1 or 2 faces with stomata");
      read.leaf = {numbers[0], numbers[1], static_cast<int>(numbers[2])};
      read.back = LibrarySurface::Back::other_side;
    } else if (key == "roughness") {
      read.roughness = roughness_of(value);
    } else if (key == "water") {
      const std::vector<double> numbers = positive(value, 2, false);
      read.wet_share = numbers[0];
      read.resistance_s_m = numbers[1];
    } else {
      fail(format("found the key '{}'", key));
    }
    for (const std::string& name : current_) surfaces.find(name)->second = read;
  }

  thermal::SolidLayer layer_of(std::string_view text) const {
    const std::optional<double> thickness = number_in(text.substr(0, text.find(' ')));
    if (!thickness) fail("expected a thickness and a solid");
    thermal::SolidLayer layer = solid_of(text).values;
    layer.thickness_m = *thickness;
    return layer;
  }

  const LibrarySolid& solid_of(std::string_view text) const {
    const std::size_t space = text.find(' ');
    if (space == std::string_view::npos) fail("expected a thickness and a solid");
    for (const LibrarySolid& solid : solids)
      if (solid.name == text.substr(space + 1)) return solid;
    fail(format("no solid is called '{}'", text.substr(space + 1)));
  }

  thermal::Roughness roughness_of(std::string_view text) const {
    for (int i = 0; i < thermal::kRoughnesses; ++i)
      if (thermal::name_of(static_cast<thermal::Roughness>(i)) == text)
        return static_cast<thermal::Roughness>(i);
    fail(format("no roughness is called '{}'", text));
  }

  std::vector<double> positive(std::string_view text, std::size_t count, bool above) const {
    std::vector<double> numbers;
    for (const Field& field : split(text, ' ')) {
      const std::optional<double> number = number_in(field.text);
      if (!number || *number < 0.0 || (above && *number == 0.0))
        fail(format("found '{}'; expected a number {}", field.text, above ? "above 0" : "from 0"));
      numbers.push_back(*number);
    }
    if (numbers.size() != count) fail(format("found {} numbers; expected {}", numbers.size(), count));
    return numbers;
  }

  LibrarySolid& solid() {
    if (solids.empty()) fail("found no 'solid' above");
    return solids.back();
  }

  const TextFile& file_;
  int line_ = 0;
  std::map<std::string, std::string, std::less<>> origins_;
  std::vector<std::string> current_;
};

}  // namespace

ThermalLibrary::ThermalLibrary(const TextFile& file) {
  ThermalTable table(file);
  table.read();
  for (const LibrarySolid& solid : table.solids)
    if (solid.source.empty() || !(solid.values.density_kg_m3 > 0.0))
      file.fail(0, 0, format("the solid '{}' has no source or no values", solid.name));
  for (const auto& [name, surface] : table.surfaces)
    if (surface.layers.empty()) file.fail(0, 0, format("the surface '{}' has no layers", name));
  solids_ = std::move(table.solids);
  surfaces_ = std::move(table.surfaces);
}

const LibrarySolid& ThermalLibrary::solid(std::string_view name) const {
  std::vector<std::string> names;
  for (const LibrarySolid& solid : solids_) {
    if (lower_case(solid.name) == lower_case(name)) return solid;
    names.push_back(solid.name);
  }
  const std::string hint = did_you_mean(std::string(name), names);
  throw InputError(format("the library has no thermal material '{}'{} It has {}", name,
                          hint.empty() ? ";" : hint, list_names(names, "and", names.size())));
}

const LibrarySurface* ThermalLibrary::surface(std::string_view spectral_name) const {
  const auto found = surfaces_.find(lower_case(spectral_name));
  return found != surfaces_.end() ? &found->second : nullptr;
}

const ThermalLibrary& thermal_library() {
  static const ThermalLibrary library{
      TextFile("thermal materials", std::string(data::thermal_materials_txt))};
  return library;
}

}  // namespace ifov::io
