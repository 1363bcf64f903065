#include "io/products/cube_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/format.h"
#include "core/parallel.h"
#include "io/products/quality_classes.h"

namespace ifov::io {
namespace {

CubeKind kind_of(int index, const render::ImageInfo& info) {
  constexpr EnviType kReal = EnviType::float32;
  switch (index) {
    case CubeSet::kRadiance:
      return {"_radiance", "radiance", "", true, {}, kReal};
    case CubeSet::kStandardError:
      return {"_standard_error", "standard error of radiance", "", true, {}, kReal};
    case CubeSet::kHalfWidth:
      return {"_half_width", "half-width of the radiance's interval", "", true, {}, kReal};
    case CubeSet::kAirHalfWidth:
      return {"_air_half_width", "part of the half-width that the air's computation adds", "", true, {}, kReal};
    case CubeSet::kSamples:
      return {"_samples",
              "samples per pixel",
              "count",
              false,
              {"samples", "label rays", "radiance evaluations"},
              EnviType::uint32};
    case CubeSet::kQuality:
      return {"_quality",
              "quality",
              "1",
              false,
              {"converged", "largest half-width over its limit", "missable fraction", "borders' share of the variance"},
              kReal};
    case CubeSet::kReasons:
      return {"_reasons", "why pixels are not converged, a bit for each reason", "1", false, {"reasons"}, EnviType::uint16};
    case CubeSet::kQualityClass:
      return {"_quality_class", "converged, or the gravest reason why not", "1", false, {"quality class"}, EnviType::byte};
    case CubeSet::kAbundance:
      return {"_abundance", "material fractions", "1", false, info.materials, kReal};
    default:
      return {"_abundance_half_width",
              "half-width of the material fractions' intervals",
              "1",
              false,
              info.materials,
              kReal};
  }
}

BilCube::Values values_of(EnviType type) {
  switch (type) {
    case EnviType::uint32:
      return BilCube::Values::integer;
    case EnviType::uint16:
      return BilCube::Values::bits;
    case EnviType::byte:
      return BilCube::Values::byte;
    default:
      return BilCube::Values::real;
  }
}

std::size_t bands_of(const CubeKind& kind, const render::ImageInfo& info) {
  return kind.spectral ? info.channels.size() : kind.band_names.size();
}

/// Largest over the channels; 1 where nothing is known.
float border_share(const sampling::TileResult& tile, std::size_t pixel) {
  if (!tile.has_errors()) return 1.0f;
  const auto columns = static_cast<std::size_t>(tile.columns);
  float share = 0.0f;
  for (std::size_t i = pixel * columns; i < (pixel + 1) * columns; ++i) {
    const float geometry = tile.variance_geometry[i], sum = geometry + tile.variance_path[i];
    if (!std::isfinite(sum)) return 1.0f;
    if (sum > 0.0f) share = std::max(share, geometry / sum);
  }
  return share;
}

std::filesystem::path with_ending(std::filesystem::path path, const std::string& ending) {
  return path += ending;
}

}  // namespace

CubeSet::Cube::Cube(CubeKind cube_kind, const std::filesystem::path& path, const render::ImageInfo& info)
    : kind(std::move(cube_kind)),
      raster(path, info.width_px, info.height_px, static_cast<int>(bands_of(kind, info)),
             values_of(kind.type)) {}

CubeSet::CubeSet(const std::filesystem::path& stem, Selection selection, const render::ImageInfo& info,
                 std::uint64_t further_bytes)
    : stem_(stem), selection_(selection), info_(info) {
  const auto pixels = static_cast<std::uint64_t>(info.width_px) * static_cast<std::uint64_t>(info.height_px);
  std::uint64_t bytes = further_bytes;
  for (int i = 0; i < kCount; ++i)
    if (selected(static_cast<Index>(i))) {
      const CubeKind kind = kind_of(i, info);
      bytes += bytes_per_value(kind.type) * pixels * bands_of(kind, info);
    }
  require_space(stem.parent_path(), bytes);
  try {
    for (int i = 0; i < kCount; ++i) {
      if (!selected(static_cast<Index>(i))) continue;
      CubeKind kind = kind_of(i, info);
      const auto path = with_ending(stem, kind.suffix + ".img");
      auto& cube = cubes_[static_cast<std::size_t>(i)];
      cube = std::make_unique<Cube>(std::move(kind), path, info);
      if (i == kRadiance || i == kHalfWidth) cube->raster.scan().want_figures();
      cube->raster.reserve();
    }
  } catch (...) {
    for (Cube* cube : cubes()) cube->raster.file().discard();
    throw;
  }
}

bool CubeSet::selected(Index index) const {
  if (index == kStandardError) return selection_.standard_error;
  if (index == kHalfWidth) return selection_.half_width;
  if (index == kAirHalfWidth)
    return selection_.half_width && std::any_of(info_.channels.begin(), info_.channels.end(),
                                                [](const render::ChannelInfo& c) { return c.air.has_value(); });
  if (index == kAbundance || index == kAbundanceHalfWidth)
    return selection_.abundance && !info_.materials.empty();
  return true;
}

std::vector<CubeSet::Cube*> CubeSet::cubes() const {
  std::vector<Cube*> result;
  for (const auto& cube : cubes_)
    if (cube) result.push_back(cube.get());
  return result;
}

void CubeSet::require_consistent(const sampling::TileResult& tile) const {
  const auto pixels = static_cast<std::size_t>(std::max(tile.tile.count(), 0));
  const std::size_t cells = pixels * info_.channels.size();
  const bool with_errors = selection_.standard_error || selection_.half_width || tile.has_errors();
  const std::size_t error_cells = with_errors ? cells : 0;
  if (tile.columns != static_cast<int>(info_.channels.size()) || tile.mean.size() != cells ||
      tile.variance_geometry.size() != error_cells || tile.variance_path.size() != error_cells ||
      tile.half_width.size() != error_cells || tile.samples.size() != pixels ||
      tile.label_rays.size() != pixels || tile.radiance_evaluations.size() != pixels ||
      tile.reasons.size() != pixels || tile.worst_ratio.size() != pixels ||
      tile.missable_fraction.size() != pixels)
    throw std::logic_error("a tile's arrays do not match its size");
}

void CubeSet::write_values(Index index, const sampling::TileResult& tile, const std::vector<float>& values) {
  cubes_[index]->raster.write(tile.tile, std::span<const float>(values));
}

void CubeSet::write(const sampling::TileResult& tile) {
  require_consistent(tile);
  write_values(kRadiance, tile, tile.mean);
  if (selection_.standard_error) {
    std::vector<float> error(tile.mean.size());
    for (std::size_t i = 0; i < error.size(); ++i)
      error[i] = std::sqrt(tile.variance_geometry[i] + tile.variance_path[i]);
    write_values(kStandardError, tile, error);
  }
  if (selection_.half_width) write_values(kHalfWidth, tile, tile.half_width);

  if (cubes_[kAirHalfWidth]) {
    std::vector<float> air(tile.mean.size(), 0.0f);
    for (std::size_t i = 0; i < air.size(); ++i)
      if (const auto& channel = info_.channels[i % info_.channels.size()]; channel.air)
        air[i] = static_cast<float>(channel.air->of(tile.mean[i]));
    write_values(kAirHalfWidth, tile, air);
  }

  const std::size_t pixels = tile.samples.size();
  std::vector<std::uint32_t> counts(3 * pixels);
  std::vector<float> quality(4 * pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    counts[3 * p] = tile.samples[p];
    counts[3 * p + 1] = tile.label_rays[p];
    counts[3 * p + 2] = tile.radiance_evaluations[p];
    quality[4 * p] = tile.converged(p) ? 1.0f : 0.0f;
    quality[4 * p + 1] = tile.worst_ratio[p];
    quality[4 * p + 2] = tile.missable_fraction[p];
    quality[4 * p + 3] = border_share(tile, p);
  }
  cubes_[kSamples]->raster.write(tile.tile, std::span<const std::uint32_t>(counts));
  write_values(kQuality, tile, quality);
  write_reasons(tile);
  if (cubes_[kAbundance]) write_fractions(tile);
}

void CubeSet::write_reasons(const sampling::TileResult& tile) {
  std::vector<std::uint8_t> classes(tile.reasons.size());
  std::transform(tile.reasons.begin(), tile.reasons.end(), classes.begin(), class_of);
  cubes_[kReasons]->raster.write(tile.tile, std::span<const std::uint16_t>(tile.reasons));
  cubes_[kQualityClass]->raster.write(tile.tile, std::span<const std::uint8_t>(classes));
}

void CubeSet::write_fractions(const sampling::TileResult& tile) {
  const std::size_t materials = info_.materials.size();
  std::vector<float> fraction(tile.samples.size() * materials, 0.0f), half_width(fraction.size(), 0.0f);
  for (const auto& a : tile.abundances) {
    if (a.pixel >= tile.samples.size() || a.material >= materials)
      throw std::logic_error("a tile's abundance names no pixel or no material");
    fraction[a.pixel * materials + a.material] = a.fraction;
    half_width[a.pixel * materials + a.material] = a.half_width;
  }
  write_values(kAbundance, tile, fraction);
  write_values(kAbundanceHalfWidth, tile, half_width);
}

void CubeSet::flush() {
  for (Cube* cube : cubes()) cube->raster.flush();
}

void CubeSet::complete(RunRecord& record) {
  flush();
  const auto open = cubes();
  parallel_for(static_cast<std::int64_t>(open.size()), record.outcome.threads, [&](std::int64_t job) {
    BilCube& raster = open[static_cast<std::size_t>(job)]->raster;
    raster.file().sync();
    raster.finish_scan();
  });
  const auto& half_width = cubes_[kHalfWidth];
  record.statistics.channels =
      channel_statistics(cubes_[kRadiance]->raster.scan(), half_width ? &half_width->raster.scan() : nullptr);
  for (Cube* cube : open) {
    BilCube& raster = cube->raster;
    const char* parts = !cube->kind.spectral ? (raster.bands() == 1 ? "band" : "bands") : raster.bands() == 1 ? "channel" : "channels";
    record.files.push_back({raster.file().final_path(),
                            format("{}, {} {}, ENVI", cube->kind.what, raster.bands(), parts), raster.bytes(),
                            raster.scan().checksum()});
  }
}

void CubeSet::write_headers(const RunIdentity& identity, const std::string& statement) {
  for (Cube* cube : cubes()) {
    cube->header = std::make_unique<PartFile>(with_ending(cube->raster.file().final_path(), ".hdr"));
    EnviHeader header = cube_header(cube->kind, info_, identity, statement);
    if (cube == cubes_[kReasons].get()) add_bit_names(header);
    if (cube == cubes_[kQualityClass].get()) add_classes(header);
    write_part(*cube->header, to_text(header));
  }
}

void CubeSet::publish() {
  // Headers of an earlier run go first: a cube without one does not look complete.
  std::error_code ignored;
  for (const Cube* cube : cubes()) std::filesystem::remove(cube->header->final_path(), ignored);
  for (Cube* cube : cubes()) {
    cube->raster.file().publish();
    cube->header->publish();
  }
}

RasterView CubeSet::view(Index index) const {
  const auto& cube = cubes_[index];
  return cube ? cube->raster.view() : RasterView{};
}

std::vector<std::filesystem::path> CubeSet::part_files() const {
  std::vector<std::filesystem::path> paths;
  for (const Cube* cube : cubes()) paths.push_back(cube->raster.file().part_path());
  return paths;
}

std::vector<std::filesystem::path> CubeSet::unselected_files() const {
  std::vector<std::filesystem::path> paths;
  for (int i = 0; i < kCount; ++i) {
    if (selected(static_cast<Index>(i))) continue;
    const std::string suffix = kind_of(i, info_).suffix;
    paths.push_back(with_ending(stem_, suffix + ".img.hdr"));
    paths.push_back(with_ending(stem_, suffix + ".img"));
  }
  return paths;
}

}  // namespace ifov::io
