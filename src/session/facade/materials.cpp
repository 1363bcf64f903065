#include "ifov/materials.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "io/figures/material_plot.h"
#include "io/library/material_library.h"
#include "io/library/material_text.h"
#include "radiometry/refractive_index.h"

namespace ifov {
namespace {

std::vector<double> values_at(const radiometry::Spectrum& spectrum, std::span<const double> wavelength_um) {
  std::vector<double> values;
  for (const double wavelength : wavelength_um) values.push_back(spectrum.at(wavelength));
  return values;
}

Material material_of(const io::LibraryMaterial& source) {
  Material material{source.name, source.group(), source.about, source.words, {}};
  for (const io::LibraryCurve& curve : source.curves) {
    const auto grid = curve.reflectance.wavelength_um();
    material.curves.push_back(
        {.name = curve.name,
         .sample = curve.sample,
         .origins = curve.origins,
         .modelled = curve.modelled,
         .first_um = curve.first_um,
         .last_um = curve.last_um,
         .wavelength_um = {grid.begin(), grid.end()},
         .reflectance = values_at(curve.reflectance, grid),
         .transmittance = curve.transmittance ? values_at(*curve.transmittance, grid) : std::vector<double>(),
         .emissivity = values_at(curve.emissivity(), grid)});
  }
  return material;
}

const io::LibraryMaterial& entry_of(const Material& material) {
  return io::material_library().find(material.name);
}

}  // namespace

std::vector<Material> search_materials(const std::string& text) {
  const io::MaterialLibrary& library = io::material_library();
  if (library.has(text)) return {material_of(library.find(text))};
  std::vector<Material> found;
  for (const io::LibraryMaterial* material : library.search(text)) found.push_back(material_of(*material));
  if (found.empty()) library.find(text);  // says what comes near
  return found;
}

std::vector<std::size_t> curves_of(const Material& material, const std::string& curve) {
  const io::LibraryMaterial& entry = entry_of(material);
  if (curve.empty()) {
    std::vector<std::size_t> all(entry.curves.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  if (curve.size() < 4 && curve.find_first_not_of("0123456789") == std::string::npos)
    return {entry.curve_numbered(std::stoi(curve))};
  return {entry.curve_named(curve)};
}

std::vector<RefractiveIndex> refractive_indices() {
  std::vector<RefractiveIndex> indices;
  for (const radiometry::RefractiveIndex& source : radiometry::refractive_indices()) {
    const auto grid = source.n.wavelength_um();
    indices.push_back({std::string(source.name),
                       std::string(source.about),
                       std::string(source.source),
                       {grid.begin(), grid.end()},
                       values_at(source.n, grid),
                       values_at(source.k, grid)});
  }
  return indices;
}

std::string refractive_indices_list(const std::vector<RefractiveIndex>& indices) {
  std::vector<io::IndexText> texts;
  for (const RefractiveIndex& one : indices)
    texts.push_back({one.name, one.about, one.source, one.wavelength_um.front(), one.wavelength_um.back()});
  return io::list_indices(texts);
}

std::string materials_list(const std::vector<Material>& materials) {
  std::vector<const io::LibraryMaterial*> entries;
  for (const Material& material : materials) entries.push_back(&entry_of(material));
  return io::list_materials(entries);
}

std::string material_text(const Material& material, const std::vector<std::size_t>& curves) {
  return io::describe_material(entry_of(material), curves);
}

std::string material_csv(const Material& material, const std::vector<std::size_t>& curves) {
  return io::material_csv(entry_of(material), curves);
}

std::string material_figure(const Material& material, const std::vector<std::size_t>& curves) {
  return io::plot_material(entry_of(material), curves);
}

}  // namespace ifov
