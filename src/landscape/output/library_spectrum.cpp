#include "landscape/output/library_spectrum.h"

#include <cctype>

#include "core/format.h"
#include "io/library/material_library.h"

namespace ifov::landscape {

io::SpectrumDocument library_spectrum(std::string_view material, int curve, SceneFolder& folder,
                                      LeafColumn column) {
  const io::LibraryMaterial& entry = io::material_library().find(material);
  const io::LibraryCurve& source = entry.curves[entry.curve_numbered(curve)];
  std::string name;
  for (const char c : entry.name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  name = format("{}_{}", name, curve);
  if (!folder.has(format("spectra/{}.csv", name))) {
    std::string rows = format("# {}: {}\n", entry.name, source.sample);
    for (const std::string& origin : source.origins) rows += format("# {}\n", origin);
    rows += format("wavelength_um,reflectance{}\n", source.transmittance ? ",transmittance" : "");
    for (const double wavelength_um : source.reflectance.wavelength_um()) {
      rows += format("{:.4g},{:.4f}", wavelength_um, source.reflectance.at(wavelength_um));
      if (source.transmittance) rows += format(",{:.4f}", source.transmittance->at(wavelength_um));
      rows += '\n';
    }
    folder.add_spectrum(name, rows);
  }
  io::CsvSpectrum csv;
  csv.file.path = format("spectra/{}.csv", name);
  csv.column = static_cast<int>(column);
  io::SpectrumDocument spectrum;
  spectrum.source = std::move(csv);
  return spectrum;
}

}  // namespace ifov::landscape
