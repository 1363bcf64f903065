#include "io/library/material_library.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/names.h"
#include "io/library/library_table.h"
#include "io/tables/text_table.h"

namespace ifov::data {
extern const std::string_view materials_vegetation_txt, materials_soil_txt, materials_water_txt,
    materials_construction_txt, materials_roof_txt, materials_metal_txt;
}

namespace ifov::io {
namespace {

/// Words in lower case; anything but letters, digits and '-' separates them.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char symbol : lower_case(text)) {
    const bool part = (symbol >= 'a' && symbol <= 'z') || (symbol >= '0' && symbol <= '9') || symbol == '-';
    if (part)
      words.back() += symbol;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::vector<std::string> searched_words(const LibraryMaterial& material) {
  std::vector<std::string> words = words_of(material.name);
  words.insert(words.end(), material.words.begin(), material.words.end());
  return words;
}

bool starts_one(const std::vector<std::string>& words, const std::string& part) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return word.starts_with(part); });
}

/// Materials that share a word with a text, or a word much like one, best first.
std::vector<std::string> near_misses(std::span<const LibraryMaterial> materials, std::string_view text) {
  const std::vector<std::string> wanted = words_of(text);
  std::vector<std::pair<int, const LibraryMaterial*>> scored;
  for (const LibraryMaterial& material : materials) {
    const std::vector<std::string> words = searched_words(material);
    int score = 0;
    for (const std::string& word : wanted)
      score += starts_one(words, word) ? 2 : nearest_name(word, words).empty() ? 0 : 1;
    if (score > 0) scored.emplace_back(-score, &material);
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [score, material] : scored)
    if (score == scored.front().first) names.push_back(material->name);
  return names;
}

}  // namespace

radiometry::Spectrum LibraryCurve::emissivity() const {
  if (!transmittance) return reflectance.complement();
  std::vector<double> values(reflectance.values().begin(), reflectance.values().end());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::max(0.0, 1.0 - values[i] - transmittance->values()[i]);
  return radiometry::Spectrum({reflectance.wavelength_um().begin(), reflectance.wavelength_um().end()},
                              std::move(values));
}

std::size_t LibraryMaterial::curve_named(std::string_view curve) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (lower_case(curves[i].name) == lower_case(curve)) return i;
    names.push_back(curves[i].name);
  }
  throw InputError(format("the material '{}' has no curve '{}'{} It has {}", name, curve,
                          did_you_mean(curve, names).empty() ? "." : did_you_mean(curve, names),
                          list_names(names, "and")));
}

std::size_t LibraryMaterial::curve_numbered(int number) const {
  if (number < 1 || number > static_cast<int>(curves.size()))
    throw InputError(format("the material '{}' has no curve {}; it has {}", name, number,
                            curves.size() == 1 ? "one" : format("1 to {}", curves.size())));
  return static_cast<std::size_t>(number - 1);
}

MaterialLibrary::MaterialLibrary(std::span<const std::pair<std::string, std::string_view>> tables) {
  for (const auto& [name, text] : tables) {
    std::vector<LibraryMaterial> more = parse_library_table(TextFile(name, std::string(text)));
    std::move(more.begin(), more.end(), std::back_inserter(materials_));
  }
}

bool MaterialLibrary::has(std::string_view name) const {
  return std::any_of(materials_.begin(), materials_.end(),
                     [wanted = lower_case(name)](const LibraryMaterial& material) {
                       return lower_case(material.name) == wanted;
                     });
}

const LibraryMaterial& MaterialLibrary::find(std::string_view name) const {
  const std::string wanted = lower_case(name);
  std::vector<std::string> names;
  for (const LibraryMaterial& material : materials_) {
    if (lower_case(material.name) == wanted) return material;
    names.push_back(material.name);
  }
  for (const LibraryMaterial& material : materials_)
    if (std::find(material.instead_of.begin(), material.instead_of.end(), wanted) !=
        material.instead_of.end())
      throw InputError(format(
          "'{}' is in the library no more, for its figures have no open licence; nearest to it is '{}'. A file "
          "of your own is read by \"ecostress\" or another key of spectra",
          name, material.name));
  const std::string likely = did_you_mean(name, names);
  std::string message = format("the library has no material '{}'", name);
  if (!likely.empty()) throw InputError(message + likely);
  const std::vector<std::string> near = near_misses(materials_, name);
  if (near.empty()) throw InputError(message + "; 'ifov materials' lists them all");
  throw InputError(message + "; near it: " + list_names(near, "and", 12));
}

std::vector<const LibraryMaterial*> MaterialLibrary::search(std::string_view text) const {
  const std::vector<std::string> wanted = words_of(text);
  std::vector<const LibraryMaterial*> found;
  for (const LibraryMaterial& material : materials_) {
    const std::vector<std::string> words = searched_words(material);
    if (std::all_of(wanted.begin(), wanted.end(),
                    [&](const std::string& part) { return starts_one(words, part); }))
      found.push_back(&material);
  }
  return found;
}

const MaterialLibrary& material_library() {
  static const MaterialLibrary library = [] {
    const std::array<std::pair<std::string, std::string_view>, 6> tables{{
        {"data/materials/vegetation.txt", data::materials_vegetation_txt},
        {"data/materials/soil.txt", data::materials_soil_txt},
        {"data/materials/water.txt", data::materials_water_txt},
        {"data/materials/construction.txt", data::materials_construction_txt},
        {"data/materials/roof.txt", data::materials_roof_txt},
        {"data/materials/metal.txt", data::materials_metal_txt},
    }};
    return MaterialLibrary(tables);
  }();
  return library;
}

}  // namespace ifov::io
