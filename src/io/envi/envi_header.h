#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ifov::io {

enum class EnviType { byte = 1, int16 = 2, int32 = 3, float32 = 4, float64 = 5, uint16 = 12, uint32 = 13 };
enum class EnviInterleave { bsq, bil, bip };

std::size_t bytes_per_value(EnviType type);

/// The fields of an ENVI header that mean something here; `other` keeps the rest as text.
struct EnviHeader {
  int samples = 0, lines = 0, bands = 0;
  std::uint64_t header_offset = 0;
  EnviType data_type = EnviType::float32;
  EnviInterleave interleave = EnviInterleave::bil;
  bool big_endian = false;
  std::string description;
  std::vector<std::string> band_names;
  std::string wavelength_units;  ///< "Micrometers", "Nanometers"
  std::vector<double> wavelength,
      fwhm;                          ///< in wavelength_units; one a band (one a sample in a spectral library)
  bool is_spectral_library = false;  ///< by its file type
  bool is_classification = false;    ///< likewise; its classes are in `other`
  std::string data_units;
  std::vector<std::string> map_info;
  std::string coordinate_system;   ///< well-known text
  std::vector<int> default_bands;  ///< from 1
  std::map<std::string, std::string> other;

  std::uint64_t data_bytes() const;
};

/// Braces and commas, which lists of a header cannot hold, become parentheses and semicolons.
std::string list_item(std::string text);

/// Header text. Names are as list_item() has them.
std::string to_text(const EnviHeader& header);

/// ifov::InputError names file, line, key, what was found and what was expected.
EnviHeader parse_envi_header(std::string_view text, const std::string& file);

}  // namespace ifov::io
