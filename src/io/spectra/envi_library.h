#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "radiometry/spectrum.h"

namespace ifov::io {

/// A spectral library as ENVI writes it: a header (`file type = ENVI Spectral Library`) with wavelengths and
/// names, and a file of numbers, one row for each spectrum. Every type of real numbers, both byte orders;
/// values are divided by the header's `reflectance scale factor`; channels that its `bbl` marks as bad are
/// left out.
class EnviLibrary {
 public:
  /// From the two files' contents; the names are for messages. Throws InputError with file and line.
  EnviLibrary(std::string_view header, const std::string& header_name, std::string_view data,
              const std::string& data_name);

  const std::vector<std::string>& names() const { return names_; }
  /// By position. Outside its wavelengths it is an error.
  const radiometry::Spectrum& spectrum(std::size_t index) const { return spectra_.at(index); }
  /// Position of the one spectrum with this name; an InputError suggests names, or says that there are
  /// several.
  std::size_t index_of(const std::string& name) const;
  /// The same from a number that counts from 1.
  std::size_t index_of(int number) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<radiometry::Spectrum> spectra_;
};

/// From the path of either file: `name.sli`, `name` or any other ending, with `name.hdr` or `name.sli.hdr`
/// beside it. Of at most 1 GiB. SystemError where one is missing.
EnviLibrary read_envi_library(const std::filesystem::path& path);

}  // namespace ifov::io
