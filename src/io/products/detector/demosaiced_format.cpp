#include <algorithm>
#include <map>
#include <vector>

#include "io/product_parts/product_headers.h"
#include "io/product_parts/run_record.h"
#include "io/products/cube_lines.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"
#include "io/quantities/mosaic_quantities.h"
#include "render/column_conversions.h"
#include "sensor/detector/mosaic.h"

namespace ifov::io {
namespace {

/// All channels of all elements from the raw mosaic; so many lines of it are looked at at a time.
void write_demosaiced(PartFile& file, const FormatInput& input) {
  const render::ImageInfo& image = input.record.image;
  const sensor::Mosaic& mosaic = *image.mosaic;
  const RasterView raw = input.values_of(quantities::kMosaic);
  const auto width = static_cast<std::size_t>(image.width_px);
  std::map<int, std::vector<float>> lines;
  const CubeLayout layout{interleave_named(input.record.interleave), image.width_px, image.height_px,
                          static_cast<int>(image.channels.size())};
  std::vector<float> made(width * image.channels.size());
  for (int y = 0; y < image.height_px; ++y) {
    for (int line = std::max(0, y - mosaic.rows); line < std::min(image.height_px, y + mosaic.rows); ++line)
      if (auto [entry, is_new] = lines.try_emplace(line); is_new) {
        entry->second.resize(width);
        raw.read(line, 0, entry->second);
      }
    lines.erase(lines.begin(), lines.lower_bound(y - mosaic.rows));
    for (std::size_t c = 0; c < image.channels.size(); ++c)
      sensor::demosaic(
          mosaic, static_cast<int>(c), y, image.height_px,
          [&](int line) -> const std::vector<float>& { return lines.at(line); },
          std::span(made).subspan(c * width, width));
    write_cube_lines(file, layout, sizeof(float), y, std::as_bytes(std::span(made)));
  }
  EnviHeader header = image_header("radiance by channel, bilinear between the elements of a mosaic", image,
                                   input.record.identity, std::string());
  add_channels(header, image);
  header.interleave = layout.interleave;
  header.data_units = image.radiance_unit;
  header.other["mosaic pattern"] = render::mosaic_pattern(image);
  input.put_header(to_text(header));
}

std::uint64_t demosaiced_bytes(const render::ImageInfo& image, const QuantitySet&) {
  return sizeof(float) * image.channels.size() * static_cast<std::uint64_t>(image.width_px) *
         static_cast<std::uint64_t>(image.height_px);
}

}  // namespace

constinit const ProductFormat formats::kDemosaiced{
    .name = "demosaiced",
    .ending = "_demosaiced.img",
    .what = "radiance by channel, bilinear between the elements of a mosaic, ENVI",
    .write = write_demosaiced,
    .suits = [](const render::ImageInfo& image) { return image.mosaic != nullptr; },
    .bytes = demosaiced_bytes,
    .has_header = true,
    .needs = &quantities::kMosaic};

}  // namespace ifov::io
