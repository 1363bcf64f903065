#include "io/products/cube_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "io/files/own_files.h"
#include "io/product_parts/product_headers.h"
#include "io/product_parts/quality_classes.h"
#include "io/products/cube_values.h"

namespace ifov::io {
namespace {

BilCube::Values values_of(EnviType type) {
  switch (type) {
    case EnviType::uint32: return BilCube::Values::integer;
    case EnviType::uint16: return BilCube::Values::bits;
    case EnviType::byte: return BilCube::Values::byte;
    case EnviType::float64: return BilCube::Values::wide;
    default: return BilCube::Values::real;
  }
}

std::filesystem::path with_ending(std::filesystem::path path, const std::string& ending) {
  return path += ending;
}

}  // namespace

CubeSet::Cube::Cube(CubeKind cube_kind, const std::filesystem::path& path, const render::ImageInfo& info,
                    PartFile::Left left)
    : kind(std::move(cube_kind)),
      raster(path, info.width_px, info.height_px, static_cast<int>(band_count(kind, info)),
             values_of(kind.type), left) {}

CubeSet::CubeSet(const std::filesystem::path& stem, ProductSet selection, const render::ImageInfo& info,
                 const Acquisition& acquisition, std::uint64_t further_bytes, PartFile::Left left)
    : stem_(stem), selection_(possible_products(selection, info)), info_(info), acquisition_(acquisition) {
  std::uint64_t bytes = further_bytes;
  for (const CubeSize& size : cube_sizes(selection_, info)) bytes += size.bytes();
  // What an earlier start has reserved is not asked for again; reserve() says where the rest is not there.
  require_space(stem.parent_path(), left == PartFile::Left::go_on ? 0 : bytes);
  try {
    for (std::size_t i = 0; i < kProductCount; ++i) {
      const auto product = static_cast<Product>(i);
      if (!selection_.has(product)) continue;
      CubeKind kind = cube_kind(product, info);
      const auto path = with_ending(stem, kind.suffix + ".img");
      auto& cube = cubes_[i];
      cube = std::make_unique<Cube>(std::move(kind), path, info, left);
      if (product == Product::radiance || product == Product::half_width) cube->raster.scan().want_figures();
      cube->raster.reserve();
    }
  } catch (...) {
    for (Cube* cube : cubes()) cube->raster.file().discard();
    throw;
  }
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
  const bool with_variances = selection_.has(Product::standard_error) || !tile.variance_geometry.empty(),
             with_errors = with_variances || selection_.has(Product::half_width) || tile.has_errors();
  const std::size_t error_cells = with_errors ? cells : 0, variance_cells = with_variances ? cells : 0;
  if (tile.columns != static_cast<int>(info_.channels.size()) || tile.mean.size() != cells ||
      tile.variance_geometry.size() != variance_cells || tile.variance_path.size() != variance_cells ||
      tile.half_width.size() != error_cells || tile.samples.size() != pixels ||
      tile.label_rays.size() != pixels || tile.radiance_evaluations.size() != pixels ||
      tile.reasons.size() != pixels || tile.worst_ratio.size() != pixels ||
      tile.missable_fraction.size() != pixels)
    throw std::logic_error("a tile's arrays do not match its size");
}

void CubeSet::write(const sampling::TileResult& tile) {
  require_consistent(tile);
  const auto put = [&](Product product, const auto& values) {
    cube(product)->raster.write(tile.tile, std::span(std::as_const(values)));
  };
  put(Product::radiance, tile.mean);
  if (cube(Product::standard_error)) {
    std::vector<float> error(tile.mean.size());
    for (std::size_t i = 0; i < error.size(); ++i)
      error[i] = std::sqrt(tile.variance_geometry[i] + tile.variance_path[i]);
    put(Product::standard_error, error);
  }
  if (cube(Product::half_width)) put(Product::half_width, tile.half_width);
  if (cube(Product::air_half_width)) put(Product::air_half_width, air_half_widths(tile, info_));
  if (cube(Product::samples)) put(Product::samples, sample_counts(tile));
  if (cube(Product::quality)) put(Product::quality, quality_values(tile));
  if (cube(Product::reasons)) put(Product::reasons, tile.reasons);
  if (cube(Product::quality_class)) {
    std::vector<std::uint8_t> classes(tile.reasons.size());
    std::transform(tile.reasons.begin(), tile.reasons.end(), classes.begin(), class_of);
    put(Product::quality_class, classes);
  }
  if (cube(Product::abundance))
    put(Product::abundance, fractions(tile, info_.materials.size(), &sampling::Abundance::fraction));
  if (cube(Product::abundance_half_width))
    put(Product::abundance_half_width,
        fractions(tile, info_.materials.size(), &sampling::Abundance::half_width));
  if (cube(Product::location)) put(Product::location, map_positions(tile, acquisition_));
  if (cube(Product::view_angles)) put(Product::view_angles, view_angles(tile, acquisition_));
}

int CubeSet::lines_written() const {
  const int lines = cube(Product::radiance)->raster.lines_written();
  const auto& errors = cube(Product::half_width);
  return errors ? std::min(lines, errors->raster.lines_written()) : lines;
}

bool CubeSet::read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const {
  const auto fill = [&](Product product, std::vector<float>& values, bool published) {
    if (values.empty()) return true;
    if (!cube(product)) return false;
    const BilCube& raster = cube(product)->raster;
    if (!published) {
      read_bil_tile([&](std::uint64_t offset, void* to,
                        std::size_t bytes) { raster.file().read_at(offset, to, bytes); },
                    raster.width(), raster.bands(), tile.tile, values);
      return true;
    }
    const OwnFile file(raster.file().final_path());
    if (!file) return false;
    read_bil_tile([&](std::uint64_t offset, void* to, std::size_t bytes) { file.read_at(offset, to, bytes); },
                  raster.width(), raster.bands(), tile.tile, values);
    return true;
  };
  for (const bool published : {false, true}) {
    try {
      if (fill(Product::radiance, tile.mean, published) &&
          fill(Product::half_width, tile.half_width, published) && is_right())
        return true;
    } catch (const EnvironmentError&) {
      // What cannot be read is not there: the caller says that it is computed again.
    }
  }
  return false;
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
  const auto& half_width = cube(Product::half_width);
  record.statistics.channels = channel_statistics(info_, cube(Product::radiance)->raster.scan(),
                                                  half_width ? &half_width->raster.scan() : nullptr);
  for (Cube* cube : open) {
    BilCube& raster = cube->raster;
    const char* parts = !cube->kind.spectral  ? (raster.bands() == 1 ? "band" : "bands")
                        : raster.bands() == 1 ? "channel"
                                              : "channels";
    record.files.push_back({raster.file().final_path(),
                            format("{}, {} {}, ENVI", cube->kind.what, raster.bands(), parts), raster.bytes(),
                            raster.scan().checksum()});
  }
}

void CubeSet::write_headers(const RunIdentity& identity, const std::string& statement) {
  for (Cube* cube : cubes()) {
    cube->header = std::make_unique<PartFile>(with_ending(cube->raster.file().final_path(), ".hdr"));
    EnviHeader header = cube_header(cube->kind, info_, identity, statement);
    if (cube->kind.product == Product::reasons) add_bit_names(header);
    if (cube->kind.product == Product::quality_class) add_classes(header);
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

RasterView CubeSet::view(Product product) const {
  const auto& chosen = cube(product);
  return chosen ? chosen->raster.view() : RasterView{};
}

std::vector<std::filesystem::path> CubeSet::part_files() const {
  std::vector<std::filesystem::path> paths;
  for (const Cube* cube : cubes()) paths.push_back(cube->raster.file().part_path());
  return paths;
}

std::vector<std::filesystem::path> CubeSet::unselected_files() const {
  std::vector<std::filesystem::path> paths;
  for (std::size_t i = 0; i < kProductCount; ++i) {
    if (selection_.has(static_cast<Product>(i))) continue;
    const std::string suffix = cube_kind(static_cast<Product>(i), info_).suffix;
    paths.push_back(with_ending(stem_, suffix + ".img.hdr"));
    paths.push_back(with_ending(stem_, suffix + ".img"));
  }
  return paths;
}

}  // namespace ifov::io
