#include "io/products/product_writer.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "core/error.h"
#include "core/parallel.h"
#include "io/products/bil_cube.h"
#include "io/products/geotiff.h"
#include "io/products/image_scan.h"
#include "io/products/map_info.h"
#include "io/products/product_headers.h"
#include "io/products/quicklook.h"
#include "io/products/run_json.h"
#include "io/report/report.h"

namespace ifov::io {
namespace {

enum CubeIndex {
  kRadiance,
  kStandardError,
  kHalfWidth,
  kSamples,
  kQuality,
  kAbundance,
  kAbundanceHalfWidth,
  kCubes
};

CubeKind kind_of(CubeIndex index, const render::ImageInfo& info) {
  switch (index) {
    case kRadiance:
      return {"_radiance", "radiance", "", true, {}, EnviType::float32};
    case kStandardError:
      return {"_standard_error", "standard error of radiance", "", true, {}, EnviType::float32};
    case kHalfWidth:
      return {"_half_width", "half-width of the radiance's interval", "", true, {}, EnviType::float32};
    case kSamples:
      return {"_samples",
              "samples per pixel",
              "count",
              false,
              {"samples", "label rays", "radiance evaluations"},
              EnviType::uint32};
    case kQuality:
      return {"_quality",
              "quality",
              "1",
              false,
              {"converged", "largest half-width over its limit", "missable fraction"},
              EnviType::float32};
    case kAbundance:
      return {"_abundance", "material fractions", "1", false, info.materials, EnviType::float32};
    case kAbundanceHalfWidth:
    case kCubes:
      break;
  }
  return {
      "_abundance_half_width", "half-width of the material fractions' intervals", "1", false, info.materials,
      EnviType::float32};
}

void require_consistent(const sampling::TileResult& tile, const render::ImageInfo& info, bool with_errors) {
  const auto pixels = static_cast<std::size_t>(std::max(tile.tile.count(), 0));
  const std::size_t cells = pixels * info.channels.size();
  const std::size_t error_cells = with_errors || tile.has_errors() ? cells : 0;
  if (tile.columns != static_cast<int>(info.channels.size()) || tile.mean.size() != cells ||
      tile.variance_geometry.size() != error_cells || tile.variance_path.size() != error_cells ||
      tile.half_width.size() != error_cells || tile.samples.size() != pixels || tile.label_rays.size() != pixels ||
      tile.radiance_evaluations.size() != pixels || tile.converged.size() != pixels ||
      tile.worst_ratio.size() != pixels || tile.missable_fraction.size() != pixels)
    throw std::logic_error("a tile's arrays do not match its size");
}

}  // namespace

struct ProductWriter::State {
  struct Cube {
    Cube(CubeKind cube_kind, const std::filesystem::path& path, const render::ImageInfo& info, int bands)
        : kind(std::move(cube_kind)),
          raster(path, info.width_px, info.height_px, bands,
                 kind.type == EnviType::uint32 ? BilCube::Values::integer : BilCube::Values::real) {}
    CubeKind kind;
    BilCube raster;
    std::unique_ptr<PartFile> header;
  };

  ProductOptions options;
  RunIdentity identity;
  render::ImageInfo info;
  std::unique_ptr<Cube> cubes[kCubes];
  std::mutex mutex;
  ImageStatistics statistics;
  bool begun = false, finished = false;

  std::filesystem::path path(const std::string& ending) const {
    return options.folder / (options.name + ending);
  }
  bool wanted(CubeIndex index) const {
    if (index == kStandardError) return options.standard_error;
    if (index == kHalfWidth) return options.half_width;
    if (index == kAbundance || index == kAbundanceHalfWidth)
      return options.abundance && !info.materials.empty();
    return true;
  }
  std::vector<Cube*> all() const {
    std::vector<Cube*> result;
    for (const auto& cube : cubes)
      if (cube) result.push_back(cube.get());
    return result;
  }

  void open_cubes();
  void count(const sampling::TileResult& tile);
  void write_fractions(const sampling::TileResult& tile);
  void scan(RunRecord& record);
  void write_headers(const RunOutcome& outcome);
  std::vector<std::unique_ptr<PartFile>> derive(RunRecord& record, std::optional<EnvironmentError>& failure);
  void publish(const RunRecord& record, std::vector<std::unique_ptr<PartFile>>& derived,
               PartFile& record_file);
  void remove_leftovers(const RunRecord& record) const;
};

void ProductWriter::State::open_cubes() {
  std::uint64_t bytes = 0;
  const auto pixels = static_cast<std::uint64_t>(info.width_px) * static_cast<std::uint64_t>(info.height_px);
  for (int i = 0; i < kCubes; ++i) {
    const auto index = static_cast<CubeIndex>(i);
    const CubeKind kind = kind_of(index, info);
    const std::uint64_t bands = kind.spectral ? info.channels.size() : kind.band_names.size();
    if (wanted(index)) bytes += 4 * pixels * bands;
    if (index == kRadiance && options.geotiff) bytes += 4 * pixels * bands;
  }
  require_space(options.folder, bytes);
  for (int i = 0; i < kCubes; ++i) {
    const auto index = static_cast<CubeIndex>(i);
    if (!wanted(index)) continue;
    const CubeKind kind = kind_of(index, info);
    const int bands = static_cast<int>(kind.spectral ? info.channels.size() : kind.band_names.size());
    cubes[i] = std::make_unique<Cube>(kind, path(kind.suffix + ".img"), info, bands);
    cubes[i]->raster.reserve();
  }
}

void ProductWriter::State::count(const sampling::TileResult& tile) {
  const std::lock_guard lock(mutex);
  ImageStatistics& s = statistics;
  if (s.pixels == 0) s.fewest_samples = tile.samples.front();
  s.pixels += static_cast<std::uint64_t>(tile.tile.count());
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    s.converged += tile.converged[p] != 0;
    s.samples += tile.samples[p];
    s.label_rays += tile.label_rays[p];
    s.radiance_evaluations += tile.radiance_evaluations[p];
    s.fewest_samples = std::min(s.fewest_samples, tile.samples[p]);
    s.most_samples = std::max(s.most_samples, tile.samples[p]);
    s.worst_ratio = std::max<double>(s.worst_ratio, tile.worst_ratio[p]);
    s.largest_missable_fraction = std::max<double>(s.largest_missable_fraction, tile.missable_fraction[p]);
  }
  s.halo_samples += tile.halo_samples;
  s.seed_samples += tile.seed_samples;
  s.probe_samples += tile.probe_samples;
  s.rays.primary += tile.rays.primary;
  s.rays.shadow += tile.rays.shadow;
  s.rays.bounce += tile.rays.bounce;
}

void ProductWriter::State::write_fractions(const sampling::TileResult& tile) {
  const std::size_t materials = info.materials.size();
  std::vector<float> fraction(tile.samples.size() * materials, 0.0f), half_width(fraction.size(), 0.0f);
  for (const auto& a : tile.abundances) {
    if (a.pixel >= tile.samples.size() || a.material >= materials)
      throw std::logic_error("a tile's abundance names no pixel or no material");
    fraction[a.pixel * materials + a.material] = a.fraction;
    half_width[a.pixel * materials + a.material] = a.half_width;
  }
  cubes[kAbundance]->raster.write(tile.tile, std::span<const float>(fraction));
  cubes[kAbundanceHalfWidth]->raster.write(tile.tile, std::span<const float>(half_width));
}

void ProductWriter::State::scan(RunRecord& record) {
  const auto open = all();
  std::vector<std::string> sums(open.size());
  const Cube* widths = cubes[kHalfWidth].get();
  for (Cube* cube : open) cube->raster.flush();
  // One job a cube, and one more for the channels' figures.
  parallel_for(static_cast<std::int64_t>(open.size()) + 1, record.outcome.threads, [&](std::int64_t job) {
    if (job == 0) {
      const RasterView half_width = widths != nullptr ? widths->raster.view() : RasterView{};
      record.statistics.channels =
          channel_statistics(cubes[kRadiance]->raster.view(), widths != nullptr ? &half_width : nullptr);
      return;
    }
    const auto k = static_cast<std::size_t>(job - 1);
    open[k]->raster.file().sync();
    sums[k] = checksum(open[k]->raster.file(), open[k]->raster.bytes());
  });
  for (std::size_t k = 0; k < open.size(); ++k) {
    const int bands = open[k]->raster.bands();
    const std::string parts = open[k]->kind.spectral ? (bands == 1 ? "channel" : "channels") : "bands";
    record.files.push_back({open[k]->raster.file().final_path(),
                            format("{}, {} {}, ENVI", open[k]->kind.what, bands, parts),
                            open[k]->raster.bytes(), sums[k]});
  }
}

void ProductWriter::State::write_headers(const RunOutcome& outcome) {
  for (Cube* cube : all()) {
    std::filesystem::path header = cube->raster.file().final_path();
    header += ".hdr";
    cube->header = std::make_unique<PartFile>(header);
    write_part(*cube->header, to_text(cube_header(cube->kind, info, identity, outcome.accuracy_statement)));
  }
}

std::vector<std::unique_ptr<PartFile>> ProductWriter::State::derive(
    RunRecord& record, std::optional<EnvironmentError>& failure) {
  std::vector<std::unique_ptr<PartFile>> files;
  const RasterView radiance = cubes[kRadiance]->raster.view();
  const auto add = [&](const std::string& ending, const std::string& what, const auto& make) {
    std::unique_ptr<PartFile> file;
    try {
      file = std::make_unique<PartFile>(path(ending));
      make(*file);
      file->sync();
      const std::uint64_t bytes = std::filesystem::file_size(file->part_path());
      record.files.push_back({file->final_path(), what, bytes, checksum(*file, bytes)});
      files.push_back(std::move(file));
    } catch (const EnvironmentError& error) {
      if (file) file->discard();
      if (!failure) failure = error;
    }
  };
  if (options.geotiff)
    add("_radiance.tif", "radiance, GeoTIFF", [&](PartFile& file) { write_geotiff(file, radiance, record); });
  if (options.quicklook)
    add("_quicklook.png", "picture", [&](PartFile& file) {
      write_part(file, make_quicklook(radiance, record, options.quicklook_channels));
    });
  if (options.report)
    add("_report.html", "report", [&](PartFile& file) {
      ReportInput input;
      input.radiance = radiance;
      input.samples = cubes[kSamples]->raster.view();
      input.quality = cubes[kQuality]->raster.view();
      if (cubes[kHalfWidth]) input.half_width = cubes[kHalfWidth]->raster.view();
      write_part(file, make_report(record, input));
    });
  return files;
}

/// Products of an earlier run of this name that this one does not replace: they would not belong to its
/// cubes.
void ProductWriter::State::remove_leftovers(const RunRecord& record) const {
  std::vector<std::filesystem::path> candidates{path("_radiance.tif"), path("_quicklook.png"),
                                                path("_report.html")};
  for (int i = 0; i < kCubes; ++i) {
    const std::string suffix = kind_of(static_cast<CubeIndex>(i), info).suffix;
    if (cubes[i]) continue;
    candidates.push_back(path(suffix + ".img.hdr"));
    candidates.push_back(path(suffix + ".img"));
  }
  std::error_code ignored;
  for (const auto& candidate : candidates)
    if (std::none_of(record.files.begin(), record.files.end(),
                     [&](const ProductFile& file) { return file.path == candidate; }))
      std::filesystem::remove(candidate, ignored);
}

void ProductWriter::State::publish(const RunRecord& record, std::vector<std::unique_ptr<PartFile>>& derived,
                                   PartFile& record_file) {
  // The old record and the old headers go first and the new record comes last: in between nothing looks
  // complete.
  std::error_code ignored;
  std::filesystem::remove(record_file.final_path(), ignored);
  for (const Cube* cube : all()) std::filesystem::remove(cube->header->final_path(), ignored);
  for (Cube* cube : all()) {
    cube->raster.file().publish();
    cube->header->publish();
  }
  for (auto& file : derived) file->publish();
  remove_leftovers(record);
  sync_folder(options.folder);
  record_file.publish();
  sync_folder(options.folder);
}

ProductWriter::ProductWriter(ProductOptions options, RunIdentity identity)
    : state_(std::make_unique<State>()) {
  state_->options = std::move(options);
  state_->identity = std::move(identity);
}

ProductWriter::~ProductWriter() {
  if (state_->finished) return;
  for (State::Cube* cube : state_->all()) {
    try {
      cube->raster.flush();
    } catch (const EnvironmentError&) {
      // Said already by the write that failed first; what is on disk stays.
    }
  }
}

void ProductWriter::begin(const render::ImageInfo& info) {
  State& s = *state_;
  if (s.begun) throw std::logic_error("begin() comes once");
  if (info.width_px < 1 || info.height_px < 1 || info.channels.empty())
    throw std::logic_error("an image needs pixels and channels");
  if (info.has_map) coordinate_system_text(info);  // an unknown system is said now, not after the last ray
  s.info = info;
  try {
    s.open_cubes();
  } catch (...) {
    for (auto& cube : s.cubes) {
      if (cube) cube->raster.file().discard();
      cube.reset();
    }
    throw;
  }
  s.begun = true;
}

void ProductWriter::write(const sampling::TileResult& tile) {
  State& s = *state_;
  if (!s.begun) throw std::logic_error("begin() comes before write()");
  require_consistent(tile, s.info, s.options.standard_error || s.options.half_width);
  s.cubes[kRadiance]->raster.write(tile.tile, std::span<const float>(tile.mean));
  if (s.cubes[kStandardError]) {
    std::vector<float> error(tile.mean.size());
    for (std::size_t i = 0; i < error.size(); ++i)
      error[i] = std::sqrt(tile.variance_geometry[i] + tile.variance_path[i]);
    s.cubes[kStandardError]->raster.write(tile.tile, std::span<const float>(error));
  }
  if (s.cubes[kHalfWidth])
    s.cubes[kHalfWidth]->raster.write(tile.tile, std::span<const float>(tile.half_width));

  const std::size_t pixels = tile.samples.size();
  std::vector<std::uint32_t> counts(3 * pixels);
  std::vector<float> quality(3 * pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    counts[3 * p] = tile.samples[p];
    counts[3 * p + 1] = tile.label_rays[p];
    counts[3 * p + 2] = tile.radiance_evaluations[p];
    quality[3 * p] = tile.converged[p] != 0 ? 1.0f : 0.0f;
    quality[3 * p + 1] = tile.worst_ratio[p];
    quality[3 * p + 2] = tile.missable_fraction[p];
  }
  s.cubes[kSamples]->raster.write(tile.tile, std::span<const std::uint32_t>(counts));
  s.cubes[kQuality]->raster.write(tile.tile, std::span<const float>(quality));
  if (s.cubes[kAbundance]) s.write_fractions(tile);
  s.count(tile);
}

RunRecord ProductWriter::finish(const RunOutcome& outcome) {
  State& s = *state_;
  const auto pixels =
      static_cast<std::uint64_t>(s.info.width_px) * static_cast<std::uint64_t>(s.info.height_px);
  if (!s.begun || s.finished || s.statistics.pixels != pixels)
    throw std::logic_error(
        format("finish() with {} of {} pixels written: the image is not whole", s.statistics.pixels, pixels));
  RunRecord record{s.identity, outcome, s.info, s.statistics, {}};
  s.scan(record);
  s.write_headers(outcome);

  std::optional<EnvironmentError> failure;
  auto derived = s.derive(record, failure);
  if (failure) record.outcome.notes.push_back(failure->what());
  PartFile record_file(s.path("_run.json"));
  write_part(record_file, to_json(record));
  s.publish(record, derived, record_file);
  record.files.push_back({record_file.final_path(), "run record", 0, ""});
  s.finished = true;
  if (failure)
    throw EnvironmentError(format("{}\nAll other products are complete in {}", failure->what(),
                                  s.options.folder.empty() ? "." : s.options.folder.string()));
  return record;
}

std::vector<std::filesystem::path> ProductWriter::part_files() const {
  std::vector<std::filesystem::path> paths;
  if (state_->finished) return paths;
  for (const State::Cube* cube : state_->all()) paths.push_back(cube->raster.file().part_path());
  return paths;
}

}  // namespace ifov::io
