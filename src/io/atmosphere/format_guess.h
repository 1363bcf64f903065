#pragma once

#include <string>
#include <string_view>

#include "io/tables/text_table.h"

namespace ifov::io {

/// What a file of another radiative transfer code is, told from its first lines.
enum class AtmosphereFormat {
  unknown,
  modtran_tape7,
  modtran_channels,
  modtran_csv,
  modtran_json,
  uvspec,
  path_csv
};

AtmosphereFormat guess_atmosphere_format(const TextFile& file);

/// "a MODTRAN tape7", "a MODTRAN channel file (.chn)", ...
std::string_view describe(AtmosphereFormat format);

/// "; the file looks like a MODTRAN channel file (.chn)" where it looks like something else than `expected`
/// (the end of its description), else nothing. For the end of a message.
std::string looks_like(const TextFile& file, std::string_view expected);

}  // namespace ifov::io
