#include <cmath>
#include <limits>

#include "core/error.h"
#include "ifov/products.h"
#include "io/json/json_writer.h"
#include "io/products/image_region.h"
#include "viewer/answers/answers.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/run_watch.h"

namespace ifov::viewer {
namespace {

/// Of all cubes that a mean over a region reads.
constexpr std::uint64_t kMostRegionBytes = std::uint64_t{4} << 30;
constexpr std::size_t kLongestRegion = 6000;
// Of a series: each time that is open holds some files.
constexpr std::size_t kSpreadTimes = 12, kSpreadPixels = 8192;
constexpr const char* kNoRun = "no run is at work in the folder, or it has just ended";

const OpenRun::Cube& cube_of(const OpenRun& run, const Query& query) {
  const std::string name = query.text("cube", 200);
  const OpenRun::Cube* cube = run.cube(name);
  if (cube == nullptr) throw Refused(404, format("the run has no cube '{}'", name));
  return *cube;
}

/// What is known of where tiles lie may be a third of a second old, and a run at work moves them: where one is not found, the run is
/// looked at once more.
RunWatch::Tile tile_of(const RunWatch& watch, const std::filesystem::path& folder, int tile, int channel) {
  const auto index = static_cast<std::size_t>(tile), column = static_cast<std::size_t>(channel);
  try {
    return watch.tile(index, column);
  } catch (const SystemError&) {
    if (!holds_unfinished_run(folder)) throw Refused(409, kNoRun);
  }
  try {
    return RunWatch(folder).tile(index, column);
  } catch (const SystemError&) {
    if (!holds_unfinished_run(folder)) throw Refused(409, kNoRun);
    throw;
  }
}

}  // namespace

/// Every `step`-th pixel of every `step`-th line, from the middle of the first such square on.
Answer Answers::band(const Query& query) {
  const auto run = this->run(query);
  const OpenRun::Cube& cube = cube_of(*run, query);
  const int band = query.integer("band", 0, cube.reader.header().bands - 1);
  const int x0 = query.integer("x0", 0, run->width_px - 1), y0 = query.integer("y0", 0, run->height_px - 1);
  const int x1 = query.integer("x1", x0 + 1, run->width_px), y1 = query.integer("y1", y0 + 1, run->height_px);
  const int step = query.integer("step", 1, 1 << 20);
  const std::size_t columns = static_cast<std::size_t>((x1 - x0 + step - 1) / step),
                    rows = static_cast<std::size_t>((y1 - y0 + step - 1) / step);
  if (rows * columns > kMostValues)
    throw Refused(400, format("{} x {} values are asked for; expected {} at most: take a larger step",
                              columns, rows, kMostValues));
  std::vector<float> values(rows * columns), line(static_cast<std::size_t>(x1 - x0));
  const auto apart = static_cast<std::size_t>(step), lines = static_cast<std::size_t>(y1 - y0);
  for (std::size_t row = 0; row < rows; ++row) {
    cube.reader.read(y0 + static_cast<int>(thinned_place(row, apart, lines)), band, line, x0);
    for (std::size_t column = 0; column < columns; ++column)
      values[row * columns + column] = line[thinned_place(column, apart, line.size())];
  }
  return numbers(values, format("{{\"columns\":{},\"rows\":{}}}", columns, rows));
}

/// Of a band of some times of a series, spread over it, every so many-th pixel: what one stretch for all times follows from. Other cubes and
/// bands come in the same order.
Answer Answers::spread(const Query& query) {
  std::vector<std::size_t> made;
  for (std::size_t k = 0; k < sources_.size(); ++k)
    if (!signature_of(sources_[k]->folder()).empty()) made.push_back(k);
  const std::size_t count = std::min(made.size(), kSpreadTimes);
  std::vector<float> values, line;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = count > 1 ? made[i * (made.size() - 1) / (count - 1)] : made[i];
    const std::shared_ptr<const OpenRun> run = look_at(k).run;
    if (!run) continue;
    const OpenRun::Cube& cube = cube_of(*run, query);
    const int band = query.integer("band", 0, cube.reader.header().bands - 1);
    const auto width = static_cast<std::size_t>(run->width_px),
               height = static_cast<std::size_t>(run->height_px);
    std::size_t apart = 1;
    while ((width / apart) * (height / apart) > kSpreadPixels) ++apart;
    line.resize(width);
    for (std::size_t y = apart / 2; y < height; y += apart) {
      cube.reader.read(static_cast<int>(y), band, line);
      for (std::size_t x = apart / 2; x < width; x += apart) values.push_back(line[x]);
    }
  }
  return numbers(values, format("{{\"times\":{}}}", count));
}

Answer Answers::pixel(const Query& query) {
  const auto run = this->run(query);
  const int x = query.integer("x", 0, run->width_px - 1), y = query.integer("y", 0, run->height_px - 1);
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  json.object([&] {
    for (const OpenRun::Cube& cube : run->cubes) json.member(cube.name, cube.reader.pixel(x, y));
  });
  return {.body = json.written()};
}

Answer Answers::region(const Query& query) {
  const auto run = this->run(query);
  const std::string corners = query.text("corners", kLongestRegion);
  // Masks name files, and map coordinates are not what the page has.
  if (corners.empty() || corners.find_first_not_of("0123456789.,-") != std::string::npos)
    throw Refused(400, "'corners' is no list of numbers x,y,x,y,...");
  if (run->record.empty())
    throw Refused(400, "means over regions need a run record, which says how its pixels err together");
  const io::ImageRegion region =
      io::ImageRegion::parse(corners, {run->width_px, run->height_px, std::nullopt});
  const std::uint64_t bytes = std::uint64_t(region.end_line() - region.first_line()) *
                              std::uint64_t(run->width_px) * (2 * run->channels.size() + 8) * sizeof(float);
  if (bytes > kMostRegionBytes)
    throw Refused(
        400, format("the region's lines hold {:.1f} GB, {:.1f} are read at most; ifov info {} --region {}",
                    double(bytes) * 1e-9, double(kMostRegionBytes) * 1e-9, run->folder.string(), corners));
  const RegionMean mean = region_means(run->record, {corners}).front();
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  json.object([&] {
    json.member("pixels", mean.pixels);
    json.member("converged", mean.converged);
    json.member("reasons", mean.reasons);
    std::vector<double> means, half_widths;
    for (const RegionMean::Channel& channel : mean.channels) {
      means.push_back(channel.pixels > 0 ? channel.mean : std::numeric_limits<double>::quiet_NaN());
      half_widths.push_back(channel.half_width);
    }
    json.member("mean", means);
    json.member("halfWidth", half_widths);
  });
  return {.body = json.written()};
}

Answer Answers::tile(const Query& query) {
  Source& asked = source(query);
  const auto watch = asked.now().watch;
  if (!watch) throw Refused(409, kNoRun);
  const int tile = query.integer("tile", 0, static_cast<int>(watch->grid().size()) - 1);
  const int channel = query.integer("band", 0, watch->channels() - 1);
  if (!watch->done()[static_cast<std::size_t>(tile)]) throw Refused(409, "the tile is not done yet");
  const sampling::PixelRect rect = watch->grid()[static_cast<std::size_t>(tile)];
  RunWatch::Tile values = tile_of(*watch, asked.folder(), tile, channel);
  std::vector<float> both = std::move(values.mean);
  both.insert(both.end(), values.worst_ratio.begin(), values.worst_ratio.end());
  return numbers(both,
                 format("{{\"x0\":{},\"y0\":{},\"x1\":{},\"y1\":{}}}", rect.x0, rect.y0, rect.x1, rect.y1));
}

}  // namespace ifov::viewer
