#include "sampling/accuracy/radiance/radiance_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "sampling/accuracy/basis/label_table.h"
#include "sampling/accuracy/basis/tile_memory.h"
#include "sampling/accuracy/radiance/strata.h"

namespace ifov::sampling {

namespace {

/// A stratum's values stand for its region as it is traced now where its area has changed by less than this
/// share.
constexpr double kSameArea = 0.05;

template <class Archive, class Nets>
void pass_nets(Archive& archive, Nets& nets, std::size_t columns, std::size_t stride) {
  archive(nets.size);
  if (nets.size == 0) return;
  archive.list(nets.drawn);
  archive.list(nets.paths);
  archive.list(nets.accepted);
  if constexpr (Archive::kReads) nets.sum.assign(nets.drawn.size() * stride, 0.0);
  for (std::size_t r = 0; r < nets.drawn.size(); ++r) archive.array(&nets.sum[r * stride], columns);
}

template <class Archive, class Rounds>
void pass_rounds(Archive& archive, Rounds& rounds, std::size_t columns, std::size_t stride) {
  std::uint64_t count = rounds.size();
  archive(count);
  if constexpr (Archive::kReads) rounds.assign(count, BlockSums(stride));
  for (auto& round : rounds) BlockSums::pass(round, archive, columns);
}

bool foretold(const SourcePixel& pixel) {
  return std::any_of(pixel.strata.begin(), pixel.strata.end(),
                     [](const Stratum& stratum) { return stratum.foretold(); });
}

}  // namespace

void RadianceMemory::remember(const SourcePixel& pixel, double predicted, TileMemory& memory) const {
  const std::size_t columns = memory.columns();
  std::vector<std::byte> bytes;
  MemoryWriter write(bytes);
  write(static_cast<std::uint8_t>(pixel.cluttered));
  if (pixel.cluttered) {
    write(ClutterBefore{pixel.clutter_count(), predicted});
    for (const ClutterRound& round : pixel.rounds) {
      write(static_cast<std::int32_t>(round.sides().columns));
      write(static_cast<std::int32_t>(round.sides().rows));
      ClutterRound::pass(round, write, columns);
    }
    if (!pixel.rounds.empty()) memory.keep_pixel(pixel.source, bytes);
    return;
  }
  // What is foretold depends on the error that is asked for.
  if (foretold(pixel)) return;
  bool any = false;
  for (std::size_t s = 0; s < pixel.strata.size(); ++s) {
    const Stratum& stratum = pixel.strata[s];
    // What strayed may have its own place in a sharper model.
    if (stratum.count() == 0 || stratum.strays > 0.0) continue;
    any = true;
    write(table_.label(stratum.label));
    write(pixel.model.area[s]);
    write(stratum.round);
    write(stratum.paths);
    pass_rounds(write, stratum.rounds, columns, stride_);
    pass_nets(write, stratum.nets, columns, stride_);
    write(stratum.twins);
    if (stratum.twins > 0.0) write.array(stratum.twin_squares.data(), columns);
    write(static_cast<std::uint64_t>(stratum.samples.size()));
    for (const std::uint32_t k : stratum.samples) {
      write(kept_->x[k]);
      write(kept_->replicates[k]);
      write.array(&kept_->values[k * stride_], columns);
    }
  }
  if (any) memory.keep_pixel(pixel.source, bytes);
}

bool RadianceMemory::recall(SourcePixel& pixel, const TileMemory& memory) const {
  if (foretold(pixel)) return false;
  const std::span<const std::byte> bytes = memory.pixel(pixel.source);
  if (bytes.empty()) return true;
  MemoryReader read(bytes);
  std::uint8_t cluttered = 0;
  read(cluttered);
  if ((cluttered != 0) != pixel.cluttered) return false;
  const std::size_t columns = memory.columns();
  if (pixel.cluttered) {
    ClutterBefore spent;
    read(spent);
    while (!read.empty()) {
      std::int32_t across = 0, down = 0;
      read(across);
      read(down);
      ClutterRound::pass(pixel.rounds.emplace_back(GridSides{across, down}, stride_, kept_ != nullptr), read,
                         columns);
    }
    return true;
  }
  bool all = true;
  while (!read.empty()) {
    Label label = 0;
    double area = 0.0;
    Stratum known;
    read(label);
    read(area);
    read(known.round);
    read(known.paths);
    pass_rounds(read, known.rounds, columns, stride_);
    pass_nets(read, known.nets, columns, stride_);
    read(known.twins);
    if (known.twins > 0.0) {
      known.twin_squares.assign(stride_, 0.0);
      read.array(known.twin_squares.data(), columns);
    }
    std::uint64_t samples = 0;
    read(samples);
    const std::size_t first = kept_ != nullptr ? kept_->x.size() : 0;
    for (std::uint64_t k = 0; k < samples; ++k) {
      if (kept_ == nullptr) throw SystemError("the memory of a kept tile is damaged");
      known.samples.push_back(static_cast<std::uint32_t>(kept_->x.size()));
      read(kept_->x.emplace_back());
      read(kept_->replicates.emplace_back());
      kept_->values.resize(kept_->values.size() + stride_, 0.0f);
      read.array(&kept_->values[kept_->values.size() - stride_], columns);
    }
    const auto region = std::find_if(pixel.strata.begin(), pixel.strata.end(), [&](const Stratum& stratum) {
      return table_.label(stratum.label) == label;
    });
    if (region == pixel.strata.end() ||
        std::abs(pixel.model.area[static_cast<std::size_t>(region - pixel.strata.begin())] - area) >
            kSameArea * area) {
      all = false;
      if (kept_ != nullptr) {
        kept_->x.resize(first);
        kept_->replicates.resize(first);
        kept_->values.resize(first * stride_);
      }
      continue;
    }
    known.label = region->label;
    known.deviation = std::move(region->deviation);
    *region = std::move(known);
  }
  return all;
}

RadianceMemory::ClutterBefore RadianceMemory::clutter_before(const TileMemory& memory, int source) {
  std::uint8_t cluttered = 0;
  ClutterBefore before;
  MemoryReader read(memory.pixel(source));
  if (!memory.pixel(source).empty()) read(cluttered);
  if (cluttered != 0) read(before);
  return before;
}

}  // namespace ifov::sampling
