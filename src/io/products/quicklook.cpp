#include "io/products/quicklook.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "io/product_parts/picture.h"
#include "io/product_parts/product_headers.h"
#include "io/products/part_file.h"
#include "io/products/quicklook_picture.h"
#include "io/quantities/radiance_quantities.h"

namespace ifov::io {
namespace {

constexpr const char *kLowName = "1st", *kHighName = "99th";

using Picture = QuicklookPicture;

std::uint32_t packed(Rgb c) { return (std::uint32_t{c.r} << 16) | (std::uint32_t{c.g} << 8) | c.b; }

double position(float value, const Range& range) {
  return std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
}

Picture one_channel(const RasterView& radiance, const RunRecord& record, int channel, int factor) {
  const auto& info = record.image;
  const auto& c = info.channels[static_cast<std::size_t>(channel)];
  Layer layer = averaged_layer(radiance, channel, factor);
  const bool thermal = is_thermal(info, channel);
  if (thermal) to_brightness_temperature_k(layer, c.centre_um);
  Picture p{format("{}  {:.4g} \u00b5m", c.name, c.centre_um),
            thermal ? "K" : shown_unit(info.radiance_unit),
            {},
            percentiles(layer, kLowShare, kHighShare),
            true,
            thermal ? &heat_colours() : &sequential_colours(),
            layer.width,
            layer.height,
            {}};
  p.caption = {format("{}; colours from the {} to the {} percentile",
                      thermal ? "Brightness temperature" : "Radiance", kLowName, kHighName)};
  for (const float value : layer.values)
    p.pixels.push_back(
        std::isfinite(value)
            ? packed((*p.colours)[static_cast<std::size_t>(std::lround(255 * position(value, p.range)))])
            : 0x808080u);
  return p;
}

Picture three_channels(const RasterView& radiance, const RunRecord& record, const std::vector<int>& channels,
                       int factor) {
  Picture p;
  std::vector<Layer> layers;
  std::vector<double> centre_um;
  for (const int channel : channels) {
    const auto& c = record.image.channels[static_cast<std::size_t>(channel)];
    layers.push_back(averaged_layer(radiance, channel, factor));
    centre_um.push_back(c.centre_um);
    p.title += format("{}{} {:.3g}", p.title.empty() ? "" : ", ", c.name, c.centre_um);
  }
  p.title = "Red, green, blue: " + p.title + " \u00b5m";
  const std::vector<Range> ranges = colour_ranges(layers, centre_um, kLowShare, kHighShare);
  std::string limits;
  for (const Range& r : ranges)
    limits += format("{}{:.3g} to {:.3g}", limits.empty() ? "" : ", ", r.low, r.high);
  p.caption = {all_visible(centre_um)
                   ? format("White as in sunlight, up to the {} percentile of luminance:", kHighName)
                   : format("Each channel from its {} to its {} percentile:", kLowName, kHighName),
               format("{} {}", limits, shown_unit(record.image.radiance_unit))};
  p.width = layers[0].width;
  p.height = layers[0].height;
  for (std::size_t i = 0; i < layers[0].values.size(); ++i) {
    Rgb colour;
    std::uint8_t* parts[] = {&colour.r, &colour.g, &colour.b};
    bool finite = true;
    for (std::size_t k = 0; k < 3; ++k) {
      finite = finite && std::isfinite(layers[k].values[i]);
      *parts[k] = finite ? srgb_code(position(layers[k].values[i], ranges[k])) : std::uint8_t{0};
    }
    p.pixels.push_back(finite ? packed(colour) : 0x808080u);
  }
  return p;
}

}  // namespace

QuicklookPicture quicklook_picture(const RasterView& radiance, const RunRecord& record,
                                   const std::vector<int>& channels, int factor) {
  const std::vector<int> chosen = channels.empty() ? picture_channels(record.image) : channels;
  return chosen.size() == 3 ? three_channels(radiance, record, chosen, factor)
                            : one_channel(radiance, record, chosen.front(), factor);
}

PictureColours picture_colours(const RasterView& radiance, const RunRecord& record,
                               const std::vector<int>& channels) {
  Picture p = quicklook_picture(radiance, record, channels, 1);
  return {p.width, p.height, std::move(p.pixels)};
}

constinit const ProductFormat formats::kPng{
    .name = "png",
    .ending = "_quicklook.png",
    .what = "picture",
    .write =
        [](PartFile& file, const FormatInput& input) {
          write_part(file, make_quicklook(input.values_of(quantities::kRadiance), input.record,
                                          input.picture_channels));
        },
    .suits = is_picture};

}  // namespace ifov::io
