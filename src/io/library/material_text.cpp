#include "io/library/material_text.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/format.h"
#include "io/library/usual_scattering.h"

namespace ifov::io {
namespace {

struct Window {
  const char* name;
  double first_um, last_um;
};
constexpr std::array<Window, 3> kWindows{
    {{"0.4-1.0 um", 0.4, 1.0}, {"1.0-2.5 um", 1.0, 2.5}, {"8-14 um", 8.0, 14.0}}};

double mean(const radiometry::Spectrum& spectrum, const Window& window) {
  return radiometry::integral(spectrum, window.first_um, window.last_um) / (window.last_um - window.first_um);
}

std::string curve_count(const LibraryMaterial& material) {
  const std::size_t count = material.curves.size();
  return count == 1 ? "1 curve" : format("{} curves", count);
}

bool any_transmittance(const LibraryMaterial& material) {
  return std::any_of(material.curves.begin(), material.curves.end(),
                     [](const LibraryCurve& curve) { return curve.transmittance.has_value(); });
}

/// Words in lines of at most 100 letters, each indented.
std::string wrapped(const std::string& words, const std::string& first, const std::string& indent) {
  std::string text, line = first;
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (line.size() > indent.size() && line.size() + word.size() + 1 > 100) {
      text += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
    at = end + 1;
  }
  return text + line + "\n";
}

std::string means(const std::string& what, const radiometry::Spectrum& spectrum) {
  std::string text = format("     mean {:<14}", what);
  for (const Window& window : kWindows) text += format("  {:.3f} at {}", mean(spectrum, window), window.name);
  return text + "\n";
}

std::string describe_curve(const LibraryCurve& curve, std::size_t number) {
  std::string text = format("  {}. {}\n", number, curve.name);
  text += wrapped(curve.sample, "     sample: ", "       ");
  text += format(
      "     {} {:g} to {:g} um; figures differ from the sample's own points by at most {:.4f}, RMS {:.4f}\n",
      curve.modelled ? "modelled" : "measured", curve.first_um, curve.last_um, curve.largest_difference,
      curve.rms_difference);
  text += means("reflectance", curve.reflectance);
  if (curve.transmittance) text += means("transmittance", *curve.transmittance);
  text += means("emissivity", curve.emissivity());
  for (const LentRange& range : curve.lent)
    text += wrapped(format("{:g} to {:g} um: {}", range.first_um, range.last_um, range.how),
                    "     not measured: ", "       ");
  for (const std::string& note : curve.notes) text += wrapped(note, "     note: ", "       ");
  return text;
}

}  // namespace

std::string list_materials(std::span<const LibraryMaterial* const> materials) {
  std::size_t width = 0;
  for (const LibraryMaterial* material : materials) width = std::max(width, material->name.size());
  std::string text, group;
  for (const LibraryMaterial* material : materials) {
    if (material->group() != group) {
      text += format("{}{}\n", group.empty() ? "" : "\n", material->group());
      group = material->group();
    }
    text += format("  {:<{}}  {}{}\n", material->name, width, curve_count(*material),
                   any_transmittance(*material) ? ", with transmittance" : "");
  }
  return text;
}

std::string list_indices(std::span<const IndexText> indices) {
  std::size_t width = 0;
  for (const IndexText& index : indices) width = std::max(width, index.name.size());
  std::string text = "complex refractive indices n + ik\n";
  for (const IndexText& index : indices) {
    text += format("  {:<{}}  {:g} to {:g} um\n", index.name, width, index.first_um, index.last_um);
    text += wrapped(index.about, "    ", "    ");
    text += wrapped(index.source, "    source:", "      ");
  }
  return text +
         "\n  in a document: \"scattering\": {\"rough_conductor\": {\"index\": \"copper\", \"roughness\": 0.2}}\n";
}

std::string describe_material(const LibraryMaterial& material, std::span<const std::size_t> curves) {
  const auto grid = material.curves.front().reflectance.wavelength_um();
  std::string text = format("{}\n", material.name) + wrapped(material.about, "  ", "  ");
  text += format("  {:g} to {:g} um, {} wavelengths, {}\n\n", grid.front(), grid.back(), grid.size(),
                 curve_count(material));
  std::set<std::string> origins;
  for (const std::size_t k : curves) {
    text += describe_curve(material.curves[k], k + 1);
    origins.insert(material.curves[k].origins.begin(), material.curves[k].origins.end());
  }
  text += "\n";
  for (const std::string& origin : origins) text += wrapped(origin, "  source: ", "    ");
  text += format("\n  in a document: \"reflectance\": {{\"library\": \"{}\"{}}}\n", material.name,
                 curves.front() > 0 ? format(", \"curve\": {}", curves.front() + 1) : "");
  if (const UsualScattering* usual = usual_scattering_of(material.name)) {
    text += wrapped(format("'{}': {}", usual->model, usual->why), "  best with", "    ");
    if (!usual->parameters.empty())
      text += format("    such as \"scattering\": {}{}\n", usual->parameters,
                     usual->has_own_reflectance ? ", and no reflectance" : "");
  }
  return text;
}

std::string material_csv(const LibraryMaterial& material, std::span<const std::size_t> curves) {
  std::string text = format("# {}\n", material.name);
  std::string heading = "wavelength_um";
  std::set<std::string> origins;
  std::vector<const radiometry::Spectrum*> columns;
  for (const std::size_t k : curves) {
    const LibraryCurve& curve = material.curves[k];
    text += format("# curve {}: {}: {}\n", k + 1, curve.name, curve.sample);
    for (const LentRange& range : curve.lent)
      text += format("# curve {} not measured {:g} to {:g} um: {}\n", k + 1, range.first_um, range.last_um,
                     range.how);
    origins.insert(curve.origins.begin(), curve.origins.end());
    columns.push_back(&curve.reflectance);
    heading += format(",reflectance_{}", k + 1);
    if (curve.transmittance) {
      columns.push_back(&*curve.transmittance);
      heading += format(",transmittance_{}", k + 1);
    }
  }
  for (const std::string& origin : origins) text += format("# source: {}\n", origin);
  text += heading + "\n";
  const auto grid = columns.front()->wavelength_um();
  for (std::size_t i = 0; i < grid.size(); ++i) {
    text += format("{:.6g}", grid[i]);
    for (const radiometry::Spectrum* column : columns) text += format(",{:.4f}", column->values()[i]);
    text += "\n";
  }
  return text;
}

}  // namespace ifov::io
