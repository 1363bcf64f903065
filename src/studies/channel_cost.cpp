#include "studies/channel_cost.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/format.h"
#include "studies/image_store.h"
#include "studies/scene_renderer.h"

namespace ifov::studies {

namespace {

constexpr double kMostTimes = 1.3;
constexpr int kGrid = 5;
constexpr int kTile_px = 20;
constexpr int kEvery = 4;  // one tile in so many
constexpr int kRepeats = 3;

}  // namespace

void add_channel_cost(const io::Document& document, const StudyOptions& options, bool quick, FigureTable& figures) {
  io::Document narrow = document;
  narrow.sensor.channels = {document.sensor.channels[document.sensor.channels.size() / 2]};
  narrow.output.quicklook_channels.clear();
  const SceneRenderer all(document, nullptr), one(narrow, nullptr);
  io::SamplingDocument sampling;
  sampling.method = io::GridSampling{kGrid, kGrid};

  const render::ImageInfo& info = all.info();
  const int across = (info.width_px + kTile_px - 1) / kTile_px, down = (info.height_px + kTile_px - 1) / kTile_px;
  std::vector<int> tiles;
  for (int k = 0; k < across * down; k += kEvery) tiles.push_back(k);
  const SceneRenderer::Choices choices{options.threads, kTile_px, tiles, options.cancel, nullptr};

  double all_s = std::numeric_limits<double>::max(), one_s = all_s;
  for (int k = 0; k < (quick ? 1 : kRepeats); ++k) {
    ImageStore image;
    one_s = std::min(one_s, one.render(sampling, choices, image));
    all_s = std::min(all_s, all.render(sampling, choices, image));
  }
  figures.at_most("channels_over_one", all_s / one_s, kMostTimes, "times",
                  format("wall time of {} channels over that of one at the same paths", info.channels.size()));
}

}  // namespace ifov::studies
