#include "io/envi/cube_layout.h"

namespace ifov::io {

std::string_view name_of(EnviInterleave interleave) {
  switch (interleave) {
    case EnviInterleave::bsq: return "bsq";
    case EnviInterleave::bip: return "bip";
    case EnviInterleave::bil: break;
  }
  return "bil";
}

EnviInterleave interleave_named(std::string_view name) {
  for (const EnviInterleave interleave : {EnviInterleave::bsq, EnviInterleave::bip})
    if (name == name_of(interleave)) return interleave;
  return EnviInterleave::bil;
}

std::uint64_t CubeLayout::place(int sample, int line, int band) const {
  const auto width = static_cast<std::uint64_t>(samples), height = static_cast<std::uint64_t>(lines),
             depth = static_cast<std::uint64_t>(bands);
  const auto x = static_cast<std::uint64_t>(sample), y = static_cast<std::uint64_t>(line),
             b = static_cast<std::uint64_t>(band);
  switch (interleave) {
    case EnviInterleave::bsq: return (b * height + y) * width + x;
    case EnviInterleave::bip: return (y * width + x) * depth + b;
    case EnviInterleave::bil: break;
  }
  return (y * depth + b) * width + x;
}

CubeLayout layout_of(const EnviHeader& header) {
  return {header.interleave, header.samples, header.lines, header.bands};
}

}  // namespace ifov::io
