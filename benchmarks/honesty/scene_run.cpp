#include "honesty/scene_run.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"
#include "honesty/single_tile.h"
#include "io/document/document.h"
#include "io/document/psf_document.h"
#include "render/field/scene_field.h"
#include "render/image_renderer.h"
#include "render/polarized/stokes_columns.h"
#include "sampling/footprint_groups.h"
#include "sampling/tile.h"
#include "scene/forest.h"
#include "sensor/camera.h"
#include "session/loaded/parts.h"
#include "session/session.h"
#include "transport/spectral_scene.h"

namespace ifov::benchmarks {

io::Document read_scene(const std::string& scene, const std::filesystem::path& work) {
  const std::string name = scene + ".json";
  std::ifstream file(std::filesystem::path(IFOV_SOURCE_DIR) / "benchmarks/honesty/scenes" / name);
  if (!file) throw std::runtime_error("no scene " + name);
  std::stringstream text;
  text << file.rdbuf();
  return io::parse_document(text.str(), (work / name).string());
}

namespace {

constexpr std::size_t kMixedPixels = 64;
constexpr double kPsfSigma_px = 0.6;

session::Session load(const HonestyCase& which, const std::filesystem::path& work) {
  io::Document document = read_scene(which.scene, work);
  if (which.psf || which.groups)
    document.sensor.psf =
        std::make_shared<const io::PsfDocument>(io::PsfDocument{{io::GaussianPsf{kPsfSigma_px}}});
  for (std::size_t c = 0; which.groups && c < document.sensor.channels.size(); ++c) {
    const double k = static_cast<double>(c);
    document.sensor.channels[c].shift_px = {{0.3 - 0.45 * k, 0.2 * k}};
  }
  document.sensor.stokes = which.stokes;
  return session::Session::load(document, nullptr);
}

/// A tile with Q and U behind the channels, whose errors are taken to be of paths.
sampling::TileResult with_stokes(const sampling::TileResult& tile) {
  const auto find = [&](const char* name) {
    for (const sampling::TileLayer& layer : tile.layers)
      if (layer.name == name) return layer.values<float>();
    throw std::runtime_error(format("a tile without '{}'", name));
  };
  const std::span<const float> mean = find(render::StokesLayers::kMean),
                               error = find(render::StokesLayers::kStandardError),
                               half_width = find(render::StokesLayers::kHalfWidth);
  const auto channels = static_cast<std::size_t>(tile.columns), columns = 3 * channels;
  sampling::TileResult result = tile;
  result.columns = static_cast<int>(columns);
  const std::size_t pixels = tile.samples.size();
  for (auto* values : {&result.mean, &result.half_width, &result.variance_geometry, &result.variance_path})
    values->assign(pixels * columns, 0.0f);
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t to = p * columns + c, i = p * channels + c, after = p * columns + c - channels;
      const float sigma = error[p * 4 * channels + c];
      result.mean[to] = c < channels ? tile.mean[i] : mean[after];
      result.half_width[to] = c < channels ? tile.half_width[i] : half_width[after];
      result.variance_geometry[to] = c < channels ? tile.variance_geometry[i] : 0.0f;
      result.variance_path[to] = c < channels ? tile.variance_path[i] : sigma * sigma;
    }
  return result;
}

/// A scene with the sampler that is judged, which may have a planted fault.
class Trial {
 public:
  Trial(const HonestyCase& which, const std::filesystem::path& work)
      : session_(load(which, work)), which_(which), sampler_(which.sampler(options_of(session_))) {}

  const session::Session::Parts& parts() const { return session_.parts(); }

  sampling::TileResult render(std::uint64_t seed) const {
    const session::Session::Parts& p = parts();
    const render::RenderJob plan = p.job();
    render::RenderJob job{plan.scene, plan.camera, plan.footprint, *sampler_};
    job.tolerance = plan.tolerance;
    job.transport = plan.transport;
    job.label_detail = which_.sun_state ? plan.label_detail : render::LabelDetail::material;
    job.seed = seed;
    job.tile_px = plan.tile_px;
    job.pilot_rays = plan.pilot_rays;
    job.steering_channels = plan.steering_channels;
    job.polarimetry = plan.polarimetry;
    job.groups = plan.groups;
    const sampling::TileResult tile = render_tile(job);
    return which_.stokes ? with_stokes(tile) : tile;
  }

  int channels() const { return static_cast<int>(parts().channels.size()); }

  PlainMeans plain(std::span<const PixelIndex> pixels, std::span<const double> wanted, std::int64_t least,
                   std::int64_t most, std::uint64_t seed) const {
    const session::Session::Parts& p = parts();
    const FieldFactory make_field = [&p] {
      return std::make_unique<render::SceneField>(*p.spectral_scene, *p.camera, p.job().transport,
                                                  render::LabelDetail::material, p.job().polarimetry);
    };
    if (p.groups == nullptr)
      return plain_means(make_field, channels() * (which_.stokes ? 3 : 1), *p.footprint, {}, pixels, wanted,
                         least, most, seed, 0);
    // Each channel about its own footprint; the others' values are not looked at.
    PlainMeans all;
    const auto columns = static_cast<std::size_t>(channels());
    for (std::size_t c = 0; c < columns; ++c) {
      const sampling::FootprintGroup& group = (*p.groups)[p.groups->group_of(static_cast<int>(c))];
      std::vector<double> own(wanted.size(), INFINITY);
      for (std::size_t k = c; k < wanted.size(); k += columns) own[k] = wanted[k];
      const PlainMeans found = plain_means(make_field, channels(), group.footprint,
                                           which_.unshifted ? sampling::Point2{} : group.shift_px, pixels,
                                           own, least, most, seed + c, 0);
      if (c == 0) all = found;
      for (std::size_t k = c; k < found.mean.size(); k += columns) {
        all.mean[k] = found.mean[k];
        all.standard_error[k] = found.standard_error[k];
        all.spread[k] = found.spread[k];
      }
    }
    return all;
  }

 private:
  static sampling::AccuracyOptions options_of(const session::Session& session) {
    const auto* sampler = dynamic_cast<const sampling::AccuracySampler*>(session.parts().plan.sampler.get());
    if (sampler == nullptr)
      throw std::runtime_error("a scene of the honesty benchmark does not ask for an accuracy");
    return sampler->options();
  }
  session::Session session_;
  HonestyCase which_;
  std::unique_ptr<sampling::PixelSampler> sampler_;
};

std::vector<PixelIndex> mixed_pixels(const Trial& trial) {
  std::vector<PixelIndex> all;
  for (int y = 0; y < trial.parts().camera->height_px(); ++y)
    for (int x = 0; x < trial.parts().camera->width_px(); ++x) all.push_back({x, y});
  const PlainMeans pilot = trial.plain(all, {}, 512, 512, 20240229);
  const auto columns = static_cast<std::size_t>(pilot.columns),
             channels = static_cast<std::size_t>(trial.channels());
  std::vector<double> spread(all.size());
  for (std::size_t k = 0; k < all.size() * channels; ++k) {
    const std::size_t i = k / channels * columns + k % channels;
    spread[k / channels] = std::max(spread[k / channels], pilot.spread[i] / pilot.mean[i]);
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return spread[a] > spread[b]; });
  std::vector<PixelIndex> mixed;
  for (const std::size_t k : order)
    if (mixed.size() < kMixedPixels && spread[k] > 0.01) mixed.push_back(all[k]);
  return mixed;
}

/// Standard errors that the reference has to reach: an eighth of the half-width, or of half the mean one
/// where a pixel's own is smaller still.
std::vector<double> wanted_errors(const sampling::TileResult& result, std::span<const PixelIndex> pixels) {
  const auto columns = static_cast<std::size_t>(result.columns);
  std::vector<double> wanted(pixels.size() * columns), mean(columns);
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const PixelIndex pixel = pixels[k / columns];
    wanted[k] = static_cast<double>(
        result.half_width[static_cast<std::size_t>(pixel.y * result.tile.width() + pixel.x) * columns +
                          k % columns]);
    mean[k % columns] += wanted[k] / static_cast<double>(pixels.size());
  }
  for (std::size_t k = 0; k < wanted.size(); ++k)
    wanted[k] = std::max(wanted[k], 0.5 * mean[k % columns]) / 8.0;
  return wanted;
}

void write_rows(const std::filesystem::path& path, const std::vector<sampling::TileResult>& results,
                std::span<const PixelIndex> pixels, const PlainMeans& reference) {
  std::ofstream file(path);
  file << "seed,x,y,channel,mean,reference,reference_error,spread,half_width,variance_geometry,variance_path,"
          "label_rays,paths\n";
  const auto columns = static_cast<std::size_t>(reference.columns);
  for (std::size_t seed = 0; seed < results.size(); ++seed)
    for (std::size_t k = 0; k < pixels.size() * columns; ++k) {
      const PixelIndex pixel = pixels[k / columns];
      const sampling::TileResult& r = results[seed];
      const std::size_t p = static_cast<std::size_t>(pixel.y * r.tile.width() + pixel.x);
      const std::size_t i = p * columns + k % columns;
      file << format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", seed, pixel.x, pixel.y, k % columns,
                     r.mean[i], reference.mean[k], reference.standard_error[k], reference.spread[k],
                     r.half_width[i], r.variance_geometry[i], r.variance_path[i], r.label_rays[p],
                     r.radiance_evaluations[p]);
    }
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

HonestyOutcome run_case(const HonestyCase& which, const std::filesystem::path& work) {
  const Trial trial(which, work);
  const std::vector<PixelIndex> pixels = mixed_pixels(trial);

  std::vector<sampling::TileResult> results(static_cast<std::size_t>(which.seeds));
  parallel_for(which.seeds, 0, [&](std::int64_t k) {
    results[static_cast<std::size_t>(k)] = trial.render(which.first_seed + static_cast<std::uint64_t>(k));
  });
  const std::vector<double> wanted = wanted_errors(results.front(), pixels);
  const PlainMeans reference = trial.plain(pixels, wanted, 4096, std::int64_t{1} << 23, 77);
  if (!which.rows.empty()) write_rows(which.rows, results, pixels, reference);
  IntervalStatistics statistics(pixels, reference);

  HonestyOutcome outcome;
  for (const sampling::TileResult& result : results) {
    statistics.add(result);
    for (const PixelIndex& pixel : pixels) {
      const auto k = static_cast<std::size_t>(pixel.y * result.tile.width() + pixel.x);
      outcome.samples_per_pixel += result.samples[k];
      outcome.paths_per_pixel += result.radiance_evaluations[k];
    }
  }
  const double count = static_cast<double>(pixels.size()) * which.seeds;
  outcome.samples_per_pixel /= count;
  outcome.paths_per_pixel /= count;
  outcome.pixels = pixels.size();
  outcome.honesty = statistics.summary();
  for (const char* component : {"", " Q", " U"})
    for (const render::ChannelInfo& channel : trial.parts().info.channels)
      if (outcome.channels.size() < outcome.honesty.size())
        outcome.channels.push_back(channel.name + component);
  return outcome;
}

void write_scene_files(const std::filesystem::path& work) {
  write_forest(work);
  // A smooth pattern of 0.25 m cells: sums of waves without a common period, 16 to 34 degrees Celsius.
  constexpr int kCells = 128;
  std::ofstream map(work / "texture.asc");
  map << format("ncols {0}\nnrows {0}\nxllcorner -16\nyllcorner -16\ncellsize 0.25\n", kCells);
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i)
      map << format("{:.3f} ", 25.0 + 4.0 * std::sin(0.9 * i + 0.31 * j) +
                                   3.0 * std::sin(0.23 * i - 1.1 * j) + 2.0 * std::sin(1.7 * i + 1.3 * j));
    map << '\n';
  }
  map.close();
  if (!map) throw std::runtime_error("cannot write " + (work / "texture.asc").string());
  // 13 x 13 slabs of 0.9 m, each turned its own way.
  std::ofstream slabs(work / "patchwork.obj");
  slabs << "usemtl slab\n";
  int corner = 0;
  for (int j = -6; j <= 6; ++j)
    for (int i = -6; i <= 6; ++i) {
      const double turn = 0.65 * i + 1.07 * j;
      for (int k = 0; k < 4; ++k)
        slabs << format("v {:.4f} {:.4f} 0.01\n", 1.02 * i + 0.03 + 0.636 * std::cos(turn + 1.5708 * k),
                        1.02 * j - 0.05 + 0.636 * std::sin(turn + 1.5708 * k));
      slabs << format("f {} {} {} {}\n", corner + 1, corner + 2, corner + 3, corner + 4);
      corner += 4;
    }
  slabs.close();
  if (!slabs) throw std::runtime_error("cannot write " + (work / "patchwork.obj").string());
}

}  // namespace ifov::benchmarks
