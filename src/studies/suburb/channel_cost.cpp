#include "studies/suburb/channel_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/samplers/plain_sampling.h"
#include "studies/common/image_store.h"
#include "studies/common/scene_renderer.h"

namespace ifov::studies {

namespace {

constexpr double kMostTimes = 1.3;
constexpr int kGrid = 5;
constexpr int kTileSide_px = 20;
constexpr int kEvery = 4;  // one tile in so many
constexpr int kTimings = 3;
constexpr double kPlantsBrightest_um = 0.87;
constexpr double kMostApart = 0.02;

/// Where plants are brightest: its paths live as long as those of all channels.
std::size_t brightest_channel(const render::ImageInfo& info) {
  const auto off = [](const render::ChannelInfo& c) { return std::abs(c.centre_um - kPlantsBrightest_um); };
  const auto nearest = std::min_element(info.channels.begin(), info.channels.end(),
                                        [&](const auto& a, const auto& b) { return off(a) < off(b); });
  return static_cast<std::size_t>(nearest - info.channels.begin());
}

}  // namespace

void add_channel_cost(const io::Document& document, const StudyOptions& options, bool quick,
                      FigureTable& figures) {
  const SceneRenderer all(document, nullptr);
  io::Document narrow = document;
  narrow.sensor.channels = {document.sensor.channels[brightest_channel(all.info())]};
  narrow.output.quicklook_channels.clear();
  const SceneRenderer one(narrow, nullptr);
  io::SamplingDocument sampling;
  sampling.method = std::make_shared<const io::GridSampling>(kGrid, kGrid);

  const render::ImageInfo& info = all.info();
  const int across = (info.width_px + kTileSide_px - 1) / kTileSide_px,
            down = (info.height_px + kTileSide_px - 1) / kTileSide_px;
  std::vector<int> tiles;
  for (int k = 0; k < across * down; k += kEvery) tiles.push_back(k);
  const SceneRenderer::Choices choices{options.threads, kTileSide_px, tiles, options.cancel, nullptr};

  double all_s = std::numeric_limits<double>::max(), one_s = all_s;
  double apart = 0.0;
  for (int k = 0; k < (quick ? 1 : kTimings); ++k) {
    ImageStore of_one, of_all;
    one_s = std::min(one_s, one.render(sampling, choices, of_one));
    all_s = std::min(all_s, all.render(sampling, choices, of_all));
    const auto rays = [](const ImageStore& image) { return static_cast<double>(image.cost().rays.total()); };
    apart = std::abs(rays(of_all) / rays(of_one) - 1.0);
  }
  figures.at_most(
      "channels_over_one", all_s / one_s, kMostTimes, "times",
      format("wall time of {} channels over that of one at the same paths", info.channels.size()));
  figures.at_most("channels_over_one_rays_apart", apart, kMostApart, "",
                  "by how much the rays of the two differ in number");
}

}  // namespace ifov::studies
