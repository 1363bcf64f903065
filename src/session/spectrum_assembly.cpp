#include "session/spectrum_assembly.h"

#include "io/spectra/csv_spectrum.h"
#include "io/spectra/ecostress.h"
#include "session/with_position.h"

namespace ifov::session {

namespace {

radiometry::OutsideRange outside_range(io::OutsideRange outside) {
  return outside == io::OutsideRange::extend ? radiometry::OutsideRange::extend : radiometry::OutsideRange::error;
}

struct Assemble {
  const io::Document& document;
  const io::SpectrumDocument& spectrum;

  radiometry::Spectrum operator()(const io::ConstantSpectrum& source) const {
    return radiometry::Spectrum::constant(source.value);
  }

  radiometry::Spectrum operator()(const io::TableSpectrum& source) const {
    return {source.wavelength_um, source.values};
  }

  radiometry::Spectrum operator()(const io::CsvSpectrum& source) const {
    return with_position(document, source.file.position, [&] {
      io::CsvSpectrumOptions options;
      options.value_column = source.column;
      options.scale = source.scale;
      // The reader knows units by name; any other number of micrometres per unit scales the wavelengths afterwards.
      const radiometry::Spectrum read = io::read_csv_spectrum(source.file.path, options);
      std::vector<double> wavelength_um(read.wavelength_um().begin(), read.wavelength_um().end());
      for (double& wavelength : wavelength_um) wavelength *= source.um_per_unit;
      return radiometry::Spectrum(std::move(wavelength_um), {read.values().begin(), read.values().end()});
    });
  }

  radiometry::Spectrum operator()(const io::EcostressSpectrum& source) const {
    std::vector<radiometry::Spectrum> parts;
    for (const io::DocumentFile& file : source.files)
      parts.push_back(with_position(document, file.position, [&] { return io::read_ecostress(file.path).reflectance; }));
    if (parts.size() == 1) return parts[0];
    return with_position(document, spectrum.position, [&] {
      return parts[0].first_um() < parts[1].first_um() ? io::join(parts[0], parts[1]) : io::join(parts[1], parts[0]);
    });
  }
};

}  // namespace

radiometry::Spectrum assemble_spectrum(const io::Document& document, const io::SpectrumDocument& spectrum,
                                       const std::string& name) {
  return with_position(document, spectrum.position, [&] {
           return std::visit(Assemble{document, spectrum}, spectrum.source);
         })
      .with_outside(outside_range(spectrum.outside))
      .with_name(name);
}

}  // namespace ifov::session
