#include "render/wings/wing_cells.h"

#include <algorithm>

#include "sampling/random.h"
#include "sampling/value_batch.h"
#include "sensor/psf_wings.h"

namespace ifov::render {

namespace {

constexpr std::uint64_t kCellPaths = 0x77696e67ull,
                        kCellPosition = 0x706c6163ull;  // purposes of random numbers

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

sampling::PixelRect wing_blocks(const sampling::PixelRect& tile, int block) {
  constexpr int kBlocks = sensor::PsfWings::kBlocks;
  const auto first = [&](int pixel) { return (floor_div(pixel, block) - kBlocks) * block; };
  const auto last = [&](int pixel) { return (floor_div(pixel, block) + kBlocks + 1) * block; };
  return {first(tile.x0), first(tile.y0), last(tile.x1 - 1), last(tile.y1 - 1)};
}

WingCells::WingCells(sampling::PixelRect pixels, int side, std::uint64_t seed, const CancelToken* cancel,
                     const WingSpots* spots, sampling::Field& field)
    : pixels_(pixels), side_(side), columns_(static_cast<std::size_t>(field.columns())) {
  const std::size_t count = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  values_.resize(4 * count * columns_);
  materials_.resize(4 * count);
  const auto point = [&](std::size_t k) {
    const int quarter = static_cast<int>(k % 4), x = cell_x(k / 4), y = cell_y(k / 4);
    const std::uint64_t key = sampling::hash(seed, side_, x, y, kCellPosition, quarter);
    const double u = 0.5 * (quarter % 2 + sampling::unit_double(key)),
                 v = 0.5 * (quarter / 2 + sampling::unit_double(key + 1));
    return sampling::FocalPoint{x + side_ * u, y + side_ * v};
  };
  sampling::for_each_value(
      field, cancel, 4 * count,
      [&](std::size_t k) {
        return sampling::PathRequest{point(k),
                                     sampling::hash(seed, side_, cell_x(k / 4), cell_y(k / 4), kCellPaths),
                                     static_cast<std::uint32_t>(k % 4)};
      },
      [&](std::size_t k, sampling::Label label, const float* values) {
        std::copy_n(values, columns_, values_.begin() + static_cast<std::ptrdiff_t>(k * columns_));
        materials_[k] = field.material_of(label);
      });
  if (spots == nullptr) return;
  for (std::size_t cell = 0; cell < count; ++cell) {
    unsigned in_spots = 0;
    for (unsigned quarter = 0; quarter < 4; ++quarter)
      if (spots->first_at(point(4 * cell + quarter)) != WingSpots::kNone) in_spots |= 1u << quarter;
    if (in_spots != 0) leave_out(cell, in_spots);
  }
}

void WingCells::leave_out(std::size_t cell, unsigned in_spots) {
  for (std::size_t c = 0; c < columns_; ++c) {
    float* const values = values_.data() + 4 * cell * columns_ + c;
    double sum = 0.0;
    int others = 0;
    float least = values[0];  // by magnitude: where all lie in spots, what is beside them is darker
    for (unsigned quarter = 0; quarter < 4; ++quarter) {
      const float value = values[quarter * columns_];
      if (std::abs(value) < std::abs(least)) least = value;
      if ((in_spots >> quarter & 1u) == 0) sum += value, ++others;
    }
    const float base = others > 0 ? static_cast<float>(sum / others) : least;
    for (unsigned quarter = 0; quarter < 4; ++quarter)
      if ((in_spots >> quarter & 1u) != 0) values[quarter * columns_] = base;
  }
}

}  // namespace ifov::render
