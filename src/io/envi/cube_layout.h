#pragma once

#include <cstdint>
#include <string_view>

#include "io/envi/envi_header.h"

namespace ifov::io {

/// "bsq", "bil", "bip": as in headers and documents.
std::string_view name_of(EnviInterleave interleave);
/// The one of such a name; bil where there is none.
EnviInterleave interleave_named(std::string_view name);

/// Where the values of a cube lie in its file.
struct CubeLayout {
  EnviInterleave interleave = EnviInterleave::bil;
  int samples = 0, lines = 0, bands = 0;

  /// In values from the first.
  std::uint64_t place(int sample, int line, int band) const;
};

CubeLayout layout_of(const EnviHeader& header);

}  // namespace ifov::io
