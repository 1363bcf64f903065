#include "io/products/cube_set.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "io/envi/cube_layout.h"
#include "io/files/own_files.h"
#include "io/product_parts/cube_tile.h"
#include "io/products/quantity_header.h"
#include "io/quantities/radiance_quantities.h"

namespace ifov::io {
namespace {

CubeFile::Values values_of(EnviType type) {
  switch (type) {
    case EnviType::uint32: return CubeFile::Values::integer;
    case EnviType::uint16: return CubeFile::Values::bits;
    case EnviType::byte: return CubeFile::Values::byte;
    case EnviType::float64: return CubeFile::Values::wide;
    case EnviType::float32: return CubeFile::Values::real;
    // No quantity has these (test_quantities).
    case EnviType::int16:
    case EnviType::int32: break;
  }
  throw std::logic_error("no cube is written of signed integers");
}

std::filesystem::path with_ending(std::filesystem::path path, const std::string& ending) {
  return path += ending;
}

std::filesystem::path cube_path(const std::filesystem::path& stem, const Quantity& quantity) {
  return with_ending(stem, format("_{}.img", quantity.name));
}

/// A tile's rectangle of a cube.
class IntoCube final : public ValueSink {
 public:
  IntoCube(CubeFile& cube, sampling::PixelRect tile) : cube_(cube), tile_(tile) {}
  void put(std::span<const float> values) override { cube_.write(tile_, values); }
  void put(std::span<const double> values) override { cube_.write(tile_, values); }
  void put(std::span<const std::uint32_t> values) override { cube_.write(tile_, values); }
  void put(std::span<const std::uint16_t> values) override { cube_.write(tile_, values); }
  void put(std::span<const std::uint8_t> values) override { cube_.write(tile_, values); }

 private:
  CubeFile& cube_;
  sampling::PixelRect tile_;
};

}  // namespace

CubeSet::Cube::Cube(const Quantity& of, const std::filesystem::path& path, const render::ImageInfo& info,
                    PartFile::Left left, EnviInterleave interleave)
    : quantity(of),
      raster(path, info.width_px, info.height_px, of.band_count(info), values_of(of.type), left, interleave) {
}

CubeSet::CubeSet(const std::filesystem::path& stem, const QuantitySet& selection,
                 const render::ImageInfo& info, const Acquisition& acquisition, std::uint64_t further_bytes,
                 PartFile::Left left, EnviInterleave interleave)
    : stem_(stem),
      selection_(possible_quantities(selection, info)),
      info_(info),
      acquisition_(acquisition),
      interleave_(interleave) {
  std::uint64_t bytes = further_bytes;
  for (const Quantity* quantity : selection_) bytes += cube_size(*quantity, info).bytes();
  // What an earlier start has reserved is not asked for again; reserve() says where the rest is not there.
  require_space(stem.parent_path(), left == PartFile::Left::go_on ? 0 : bytes);
  try {
    for (const Quantity* quantity : selection_) {
      const auto& cube = cubes_.emplace_back(
          std::make_unique<Cube>(*quantity, cube_path(stem, *quantity), info, left, interleave));
      if (quantity == &quantities::kRadiance || quantity == &quantities::kHalfWidth)
        cube->raster.scan().want_figures();
      cube->raster.reserve();
    }
  } catch (...) {
    for (const auto& cube : cubes_) cube->raster.file().discard();
    throw;
  }
}

CubeSet::Cube* CubeSet::cube(const Quantity& quantity) const {
  for (const auto& cube : cubes_)
    if (&cube->quantity == &quantity) return cube.get();
  return nullptr;
}

void CubeSet::write(const sampling::TileResult& tile) {
  if (const std::string fault = tile.fault(); !fault.empty())
    throw std::logic_error("a tile's arrays do not match its size: " + fault);
  if (tile.columns != static_cast<int>(info_.channels.size()))
    throw std::logic_error(format("a tile of {} columns, not {}", tile.columns, info_.channels.size()));
  for (const auto& cube : cubes_) {
    IntoCube sink(cube->raster, tile.tile);
    cube->quantity.values({tile, info_, acquisition_}, sink);
  }
}

int CubeSet::lines_written() const {
  const int lines = cube(quantities::kRadiance)->raster.lines_written();
  const Cube* const errors = cube(quantities::kHalfWidth);
  return errors ? std::min(lines, errors->raster.lines_written()) : lines;
}

bool CubeSet::read_values(sampling::TileResult& tile, const std::function<bool()>& is_right) const {
  const auto fill = [&](const Quantity& quantity, std::vector<float>& values, bool published) {
    if (values.empty()) return true;
    if (cube(quantity) == nullptr) return false;
    const CubeFile& raster = cube(quantity)->raster;
    if (!published) {
      read_cube_tile([&](std::uint64_t offset, void* to,
                         std::size_t bytes) { raster.file().read_at(offset, to, bytes); },
                     raster.layout(), tile.tile, values);
      return true;
    }
    const OwnFile file(raster.file().final_path());
    if (!file) return false;
    read_cube_tile(
        [&](std::uint64_t offset, void* to, std::size_t bytes) { file.read_at(offset, to, bytes); },
        raster.layout(), tile.tile, values);
    return true;
  };
  for (const bool published : {false, true}) {
    try {
      if (fill(quantities::kRadiance, tile.mean, published) &&
          fill(quantities::kHalfWidth, tile.half_width, published) && is_right())
        return true;
    } catch (const SystemError&) {
      // What cannot be read is not there: the caller says that it is computed again.
    }
  }
  return false;
}

void CubeSet::flush() {
  for (const auto& cube : cubes_) cube->raster.flush();
}

void CubeSet::complete(RunRecord& record) {
  flush();
  parallel_for(static_cast<std::int64_t>(cubes_.size()), record.outcome.threads, [&](std::int64_t job) {
    CubeFile& raster = cubes_[static_cast<std::size_t>(job)]->raster;
    raster.file().sync();
    raster.finish_scan();
  });
  Cube* const half_width = cube(quantities::kHalfWidth);
  record.statistics.channels = channel_statistics(
      info_, cube(quantities::kRadiance)->raster.scan(),
      half_width != nullptr ? &half_width->raster.scan() : nullptr, record.identity.confidence);
  for (const auto& cube : cubes_) {
    CubeFile& raster = cube->raster;
    const char* parts = !cube->quantity.is_spectral() ? (raster.bands() == 1 ? "band" : "bands")
                        : raster.bands() == 1         ? "channel"
                                                      : "channels";
    record.files.push_back(
        {raster.file().final_path(),
         format("{}, {} {}, ENVI{}", cube->quantity.what, raster.bands(), parts,
                interleave_ == EnviInterleave::bil ? "" : format(" ({})", name_of(interleave_))),
         raster.bytes(), raster.scan().checksum()});
  }
}

void CubeSet::write_headers(const RunIdentity& identity, const std::string& statement) {
  for (const auto& cube : cubes_) {
    cube->header = std::make_unique<PartFile>(with_ending(cube->raster.file().final_path(), ".hdr"));
    EnviHeader header = header_of(cube->quantity, info_, identity, statement);
    header.interleave = interleave_;
    write_part(*cube->header, to_text(header));
  }
}

void CubeSet::publish() {
  // Headers of an earlier run go first: a cube without one does not look complete.
  std::error_code ignored;
  for (const auto& cube : cubes_) std::filesystem::remove(cube->header->final_path(), ignored);
  for (const auto& cube : cubes_) {
    cube->raster.file().publish();
    cube->header->publish();
  }
}

RasterView CubeSet::view(const Quantity& quantity) const {
  const Cube* const chosen = cube(quantity);
  return chosen != nullptr ? chosen->raster.view() : RasterView{};
}

WideView CubeSet::wide_view(const Quantity& quantity) const {
  const Cube* const chosen = cube(quantity);
  return chosen != nullptr ? chosen->raster.wide_view() : WideView{};
}

std::vector<std::filesystem::path> CubeSet::part_files() const {
  std::vector<std::filesystem::path> paths;
  for (const auto& cube : cubes_) paths.push_back(cube->raster.file().part_path());
  return paths;
}

std::vector<std::filesystem::path> CubeSet::unselected_files() const {
  std::vector<std::filesystem::path> paths;
  for (const Quantity* quantity : all_quantities()) {
    if (selection_.has(*quantity)) continue;
    const std::filesystem::path path = cube_path(stem_, *quantity);
    paths.push_back(with_ending(path, ".hdr"));
    paths.push_back(path);
  }
  return paths;
}

}  // namespace ifov::io
