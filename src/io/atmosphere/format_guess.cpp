#include "io/atmosphere/format_guess.h"

#include <algorithm>

#include "atmosphere/imported_path.h"
#include "core/format.h"
#include "io/atmosphere/modtran_columns.h"

namespace ifov::io {
namespace {

constexpr int kLinesLookedAt = 40;

bool contains(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

bool is_path_csv_heading(const std::vector<Field>& fields) {
  return fields.size() >= 2 &&
         (fields[0].text == "wavelength_um" || fields[0].text == "wavelength_nm" ||
          fields[0].text == "wavenumber_cm-1") &&
         atmosphere::path_quantity(fields[1].text).has_value();
}

AtmosphereFormat format_of(std::string_view line) {
  if (contains(line, "1ST SPECTRAL") && contains(line, "LOS")) return AtmosphereFormat::modtran_channels;
  if (contains(line, "\"MODTRAN\"") || contains(line, "\"MODTRANINPUT\""))
    return AtmosphereFormat::modtran_json;
  if (contains(line, ",")) {
    const std::vector<Field> fields = split(line, ',');
    if (is_path_csv_heading(fields)) return AtmosphereFormat::path_csv;
    if (modtran_spectral_heading(fields[0].text) &&
        std::any_of(fields.begin() + 1, fields.end(),
                    [](const Field& field) { return modtran_column(field.text).has_value(); }))
      return AtmosphereFormat::modtran_csv;
    return AtmosphereFormat::unknown;
  }
  const std::vector<Field> words = split(line, ' ');
  if (words.size() >= 3 && modtran_spectral_heading(words[0].text)) return AtmosphereFormat::modtran_tape7;
  return AtmosphereFormat::unknown;
}

bool is_row_of_numbers(std::string_view line) {
  const std::vector<Field> words = split(line, ' ');
  return words.size() >= 2 && std::all_of(words.begin(), words.end(),
                                          [](const Field& word) { return number_in(word.text).has_value(); });
}

}  // namespace

AtmosphereFormat guess_atmosphere_format(const TextFile& file) {
  for (int number = 1; number <= std::min(kLinesLookedAt, file.line_count()); ++number) {
    const AtmosphereFormat format = format_of(file.line(number));
    if (format != AtmosphereFormat::unknown) return format;
  }
  if (file.line_count() > 0 && is_row_of_numbers(file.line(1))) return AtmosphereFormat::uvspec;
  return AtmosphereFormat::unknown;
}

std::string_view describe(AtmosphereFormat format) {
  switch (format) {
    case AtmosphereFormat::modtran_tape7: return "a MODTRAN tape7";
    case AtmosphereFormat::modtran_channels: return "a MODTRAN channel file (.chn)";
    case AtmosphereFormat::modtran_csv: return "a table of MODTRAN 6 (.csv)";
    case AtmosphereFormat::modtran_json: return "a MODTRAN 6 input file (.json)";
    case AtmosphereFormat::uvspec: return "the output of libRadtran's uvspec";
    case AtmosphereFormat::path_csv: return "a table of paths (.csv)";
    case AtmosphereFormat::unknown: break;
  }
  return "no file that is known here";
}

std::string looks_like(const TextFile& file, std::string_view expected) {
  const AtmosphereFormat guess = guess_atmosphere_format(file);
  if (guess == AtmosphereFormat::unknown || contains(describe(guess), expected)) return {};
  return format("; the file looks like {}", describe(guess));
}

}  // namespace ifov::io
