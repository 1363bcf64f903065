#include "io/products/cube_lines.h"

#include <algorithm>
#include <vector>

#include "io/product_parts/turned_bands.h"
#include "io/products/part_file.h"

namespace ifov::io {

void write_cube_lines(PartFile& file, const CubeLayout& layout, std::size_t value_bytes, int first,
                      std::span<const std::byte> lines) {
  const auto samples = static_cast<std::size_t>(layout.samples),
             bands = static_cast<std::size_t>(layout.bands);
  const std::size_t row_bytes = samples * value_bytes, line_bytes = row_bytes * bands,
                    count = lines.size() / line_bytes;
  std::vector<std::byte> moved;
  switch (layout.interleave) {
    case EnviInterleave::bil: break;
    case EnviInterleave::bip:
      moved.resize(lines.size());
      for (std::size_t line = 0; line < count; ++line)
        turn_bands(lines.data() + line * line_bytes, bands, samples, moved.data() + line * line_bytes, bands,
                   value_bytes);
      lines = moved;
      break;
    case EnviInterleave::bsq:
      moved.resize(row_bytes * count);
      for (std::size_t band = 0; band < bands; ++band) {
        for (std::size_t line = 0; line < count; ++line)
          std::copy_n(lines.data() + line * line_bytes + band * row_bytes, row_bytes,
                      moved.data() + line * row_bytes);
        file.write_at(value_bytes * layout.place(0, first, static_cast<int>(band)), moved.data(),
                      moved.size());
      }
      return;
  }
  file.write_at(value_bytes * layout.place(0, first, 0), lines.data(), lines.size());
}

void write_cube_bands(PartFile& file, const CubeLayout& layout, std::size_t value_bytes, int line,
                      int first_band, std::span<const std::byte> values) {
  const auto samples = static_cast<std::size_t>(layout.samples);
  const std::size_t row_bytes = samples * value_bytes, count = values.size() / row_bytes;
  switch (layout.interleave) {
    case EnviInterleave::bil: break;
    case EnviInterleave::bip: {
      const auto bands = static_cast<std::size_t>(layout.bands);
      if (count == bands) return write_cube_lines(file, layout, value_bytes, line, values);
      std::vector<std::byte> whole(row_bytes * bands);
      const std::uint64_t begin = value_bytes * layout.place(0, line, 0);
      file.read_at(begin, whole.data(), whole.size());
      for (std::size_t band = 0; band < count; ++band)
        for (std::size_t x = 0; x < samples; ++x)
          std::copy_n(values.data() + (band * samples + x) * value_bytes, value_bytes,
                      whole.data() + (x * bands + static_cast<std::size_t>(first_band) + band) * value_bytes);
      file.write_at(begin, whole.data(), whole.size());
      return;
    }
    case EnviInterleave::bsq:
      for (std::size_t band = 0; band < count; ++band)
        file.write_at(value_bytes * layout.place(0, line, first_band + static_cast<int>(band)),
                      values.data() + band * row_bytes, row_bytes);
      return;
  }
  file.write_at(value_bytes * layout.place(0, line, first_band), values.data(), values.size());
}

}  // namespace ifov::io
