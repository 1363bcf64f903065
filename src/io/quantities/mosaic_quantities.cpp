#include "io/quantities/mosaic_quantities.h"

#include <array>
#include <limits>
#include <vector>

#include "core/format.h"
#include "render/column_conversions.h"
#include "render/image_info.h"
#include "sampling/tile.h"
#include "sensor/detector/mosaic.h"

namespace ifov::io::quantities {
namespace {

constexpr std::array<std::string_view, 1> kOneBand{"mosaic"};

/// The channel of each pixel of a tile.
template <class Visit>
void for_each_element(const FinishedTile& of, const Visit& visit) {
  const sampling::PixelRect& tile = of.tile.tile;
  std::size_t pixel = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x)
      visit(pixel++, static_cast<std::size_t>(of.image.mosaic->channel_at(x, y)));
}

void put_own(const FinishedTile& of, const std::vector<float>& by_channel, ValueSink& sink) {
  const std::size_t channels = of.image.channels.size();
  std::vector<float> own(static_cast<std::size_t>(of.tile.tile.count()));
  for_each_element(of, [&](std::size_t pixel, std::size_t channel) {
    own[pixel] = by_channel[pixel * channels + channel];
  });
  sink.put(own);
}

void put_mosaic(const FinishedTile& of, ValueSink& sink) { put_own(of, of.tile.mean, sink); }
void put_half_width_of_mosaic(const FinishedTile& of, ValueSink& sink) {
  put_own(of, of.tile.half_width, sink);
}

void put_separate(const FinishedTile& of, ValueSink& sink) {
  const std::size_t channels = of.image.channels.size();
  std::vector<float> values(of.tile.mean.size(), std::numeric_limits<float>::quiet_NaN());
  for_each_element(of, [&](std::size_t pixel, std::size_t channel) {
    values[pixel * channels + channel] = of.tile.mean[pixel * channels + channel];
  });
  sink.put(values);
}

void tell_pattern(EnviHeader& header, const render::ImageInfo& image) {
  header.other["mosaic pattern"] = render::mosaic_pattern(image);
}

}  // namespace

constinit const Quantity kMosaic{.name = "mosaic",
                                 .what = "radiance that each element sees through its own filter",
                                 .unit = "",
                                 .role = Quantity::Role::radiance,
                                 .statistic = Quantity::Statistic::mean,
                                 .type = EnviType::float32,
                                 .bands = Quantity::Bands::named,
                                 .band_names = kOneBand,
                                 .needs = {.radiance = true, .mosaic = true},
                                 .values = put_mosaic,
                                 .complete_header = tell_pattern};

constinit const Quantity kMosaicHalfWidth{.name = "mosaic_half_width",
                                          .what = "half-width of the interval of the mosaic's radiance",
                                          .unit = "",
                                          .role = Quantity::Role::error,
                                          .statistic = Quantity::Statistic::half_width,
                                          .type = EnviType::float32,
                                          .bands = Quantity::Bands::named,
                                          .band_names = kOneBand,
                                          .needs = {.errors = true, .radiance = true, .mosaic = true},
                                          .values = put_half_width_of_mosaic,
                                          .complete_header = tell_pattern};

constinit const Quantity kMosaicChannels{.name = "mosaic_channels",
                                         .what = "radiance by channel, of elements that see it alone",
                                         .unit = "",
                                         .role = Quantity::Role::radiance,
                                         .statistic = Quantity::Statistic::mean,
                                         .type = EnviType::float32,
                                         .bands = Quantity::Bands::channels,
                                         .band_names = {},
                                         .needs = {.radiance = true, .mosaic = true},
                                         .values = put_separate,
                                         .complete_header = tell_pattern};

}  // namespace ifov::io::quantities
