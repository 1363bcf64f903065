#include "session/assembly/shared/spectrum_assembly.h"

#include "io/document/spectrum_document.h"
#include "io/library/material_library.h"
#include "io/spectra/asd.h"
#include "io/spectra/csv_spectrum.h"
#include "io/spectra/ecostress.h"
#include "io/spectra/ems.h"
#include "io/spectra/envi_library.h"
#include "io/spectra/sample_spectrum.h"
#include "io/spectra/usgs.h"
#include "session/assembly/shared/with_position.h"

namespace ifov::session {

namespace {

radiometry::OutsideRange outside_range(io::OutsideRange outside) {
  switch (outside) {
    case io::OutsideRange::error: return radiometry::OutsideRange::error;
    case io::OutsideRange::extend: return radiometry::OutsideRange::extend;
  }
  return radiometry::OutsideRange::error;
}

/// The two halves of a spectrum, given in either order.
radiometry::Spectrum joined(const radiometry::Spectrum& one, const radiometry::Spectrum& other) {
  return one.first_um() < other.first_um() ? io::join(one, other) : io::join(other, one);
}

/// Wavelengths in another unit than the document says.
void require_optical(const radiometry::Spectrum& read) {
  constexpr double kLongest_um = 150.0, kShortest_um = 0.02;
  const char* const unit = read.first_um() > kLongest_um   ? "nm"
                           : read.last_um() < kShortest_um ? "um"
                                                           : nullptr;
  if (unit != nullptr)
    throw InputError(format(
        "its wavelengths reach from {:g} to {:g} um: are they {} in the file? Then say \"wavelength_unit\": "
        "\"{}\"",
        read.first_um(), read.last_um(), unit, unit));
}

struct Assemble {
  const io::DocumentSources& sources;
  const io::SpectrumDocument& spectrum;

  /// Reads and, where something is wrong, says so at the place in the document that names the file.
  template <class Read>
  auto from(const io::DocumentFile& file, const Read& read) const {
    return with_position(sources, file.position, read);
  }

  /// The part of a file's spectrum that counts, without the noise of the measurement.
  radiometry::Spectrum counted(const radiometry::Spectrum& values) const {
    if (!spectrum.range_um) return io::without_noise(values);
    return io::without_noise(io::cut(values, {(*spectrum.range_um)[0], (*spectrum.range_um)[1]}));
  }

  /// What was asked for, from what was measured of an opaque sample.
  radiometry::Spectrum of_sample(const radiometry::Spectrum& measured, io::SampleQuantity quantity) const {
    const radiometry::Spectrum values = counted(measured);
    const bool same =
        (spectrum.quantity == io::SpectrumOf::reflectance && quantity == io::SampleQuantity::reflectance) ||
        (spectrum.quantity == io::SpectrumOf::emissivity && quantity == io::SampleQuantity::emissivity) ||
        (spectrum.quantity == io::SpectrumOf::transmittance && quantity == io::SampleQuantity::transmittance);
    if (same) return values;
    if (spectrum.quantity == io::SpectrumOf::transmittance || quantity == io::SampleQuantity::transmittance)
      throw InputError(format("the file holds the {} of a sample, which does not give what is asked for",
                              io::quantity_name(quantity)));
    return values.complement();
  }

  radiometry::Spectrum operator()(const io::ConstantSpectrum& source) const {
    return radiometry::Spectrum::constant(source.value);
  }

  radiometry::Spectrum operator()(const io::TableSpectrum& source) const {
    return {source.wavelength_um, source.values};
  }

  radiometry::Spectrum operator()(const io::CsvSpectrum& source) const {
    return from(source.file, [&] {
      io::CsvSpectrumOptions options;
      options.value_column = source.column;
      options.scale = source.scale;
      // The reader knows units by name; any other number of micrometres per unit scales the wavelengths afterwards.
      const radiometry::Spectrum read = io::read_csv_spectrum(source.file.path, options);
      std::vector<double> wavelength_um(read.wavelength_um().begin(), read.wavelength_um().end());
      for (double& wavelength : wavelength_um) wavelength *= source.um_per_unit;
      const radiometry::Spectrum all(std::move(wavelength_um), {read.values().begin(), read.values().end()});
      require_optical(all);
      return spectrum.range_um ? io::cut(all, {(*spectrum.range_um)[0], (*spectrum.range_um)[1]}) : all;
    });
  }

  radiometry::Spectrum operator()(const io::EcostressSpectrum& source) const {
    std::vector<radiometry::Spectrum> parts;
    for (const io::DocumentFile& file : source.files)
      parts.push_back(from(file, [&] { return io::read_ecostress(file.path).reflectance; }));
    return with_position(sources, spectrum.position, [&] {
      return of_sample(parts.size() == 1 ? parts[0] : joined(parts[0], parts[1]),
                       io::SampleQuantity::reflectance);
    });
  }

  radiometry::Spectrum operator()(const io::UsgsSpectrum& source) const {
    return from(source.file, [&] {
      const io::SampleSpectrum read = source.wavelengths
                                          ? io::read_usgs(source.file.path, source.wavelengths->path)
                                          : io::read_usgs(source.file.path);
      return of_sample(read.values, read.quantity);
    });
  }

  radiometry::Spectrum operator()(const io::AsdSpectrum& source) const {
    return from(source.file, [&] {
      const io::SampleSpectrum read = io::read_asd(source.file.path);
      return of_sample(read.values, read.quantity);
    });
  }

  radiometry::Spectrum operator()(const io::SliSpectrum& source) const {
    return from(source.file, [&] {
      const io::EnviLibrary library = io::read_envi_library(source.file.path);
      const std::size_t index =
          std::visit([&](const auto& which) { return library.index_of(which); }, source.which);
      return counted(library.spectrum(index).scaled(source.scale));
    });
  }

  radiometry::Spectrum operator()(const io::EmsSpectrum& source) const {
    return from(source.file, [&] {
      const io::EmsFile read = io::read_ems(source.file.path);
      if (source.curve > static_cast<int>(read.curves.size()))
        throw InputError(format("'{}' has no curve {}; it holds 1 to {}", source.file.path, source.curve,
                                read.curves.size()));
      return of_sample(read.curves[static_cast<std::size_t>(source.curve - 1)],
                       io::SampleQuantity::emissivity);
    });
  }

  radiometry::Spectrum operator()(const io::LibrarySource& source) const {
    const io::LibraryCurve& curve = io::material_library().find(source.material).curves.at(source.curve);
    switch (spectrum.quantity) {
      case io::SpectrumOf::emissivity: return curve.emissivity();
      case io::SpectrumOf::transmittance: return curve.transmittance.value();
      case io::SpectrumOf::reflectance:
      case io::SpectrumOf::fraction:
      case io::SpectrumOf::number: return curve.reflectance;
      case io::SpectrumOf::radiance:
      case io::SpectrumOf::irradiance: break;
    }
    throw InputError(format("'{}' of the library is a material: it has no radiance", source.material));
  }

  radiometry::Spectrum operator()(const io::JoinedSpectrum& source) const {
    const auto part = [&](const io::SpectrumDocument& one) {
      return assemble_spectrum(sources, one, "a part to join");
    };
    return joined(part(source.parts[0]), part(source.parts[1]));
  }
};

}  // namespace

radiometry::Spectrum assemble_spectrum(const io::DocumentSources& sources,
                                       const io::SpectrumDocument& spectrum, const std::string& name) {
  return with_position(sources, spectrum.position,
                       [&] {
                         return std::visit(Assemble{sources, spectrum}, spectrum.source);
                       })
      .with_outside(outside_range(spectrum.outside))
      .with_name(name);
}

}  // namespace ifov::session
