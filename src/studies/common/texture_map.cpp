#include "studies/common/texture_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/format.h"
#include "sampling/random.h"
#include "studies/common/study_files.h"

namespace ifov::studies {

namespace {

constexpr int kWaves = 12;
constexpr double kShortest_m = 0.05, kLongest_m = 1.0, kRms_k = 2.0, kCell_m = 0.01;
constexpr std::uint64_t kTexture = 0x74657874ull;

}  // namespace

TextureMap::TextureMap(std::uint64_t seed, double side_m)
    : side_(side_m), cells_(static_cast<int>(std::lround(side_m / kCell_m))) {
  struct Wave {
    double kx, ky, phase;
  };
  std::vector<Wave> waves;
  for (int k = 0; k < kWaves; ++k) {
    const auto random = [&](int what) {
      return sampling::unit_double(sampling::hash(seed, kTexture, k, what));
    };
    const double length = kShortest_m * std::pow(kLongest_m / kShortest_m, (k + random(0)) / kWaves);
    const double number = 2.0 * std::numbers::pi / length, direction = 2.0 * std::numbers::pi * random(1);
    waves.push_back(
        {number * std::cos(direction), number * std::sin(direction), 2.0 * std::numbers::pi * random(2)});
  }
  const double amplitude = kRms_k * std::sqrt(2.0 / kWaves);
  for (int row = 0; row < cells_; ++row)
    for (int column = 0; column < cells_; ++column) {
      const double x = (column + 0.5) * kCell_m, y = side_ - (row + 0.5) * kCell_m;
      double sum = 0.0;
      for (const Wave& w : waves) sum += std::cos(w.kx * x + w.ky * y + w.phase);
      difference_k_.push_back(static_cast<float>(amplitude * sum));
    }
}

double TextureMap::at(double x_m, double y_m) const {
  const auto clamped = [&](double cells) { return std::clamp(cells - 0.5, 0.0, cells_ - 1.0); };
  const double column = clamped(x_m / kCell_m), row = clamped((side_ - y_m) / kCell_m);
  const int i = std::min(static_cast<int>(column), cells_ - 2),
            j = std::min(static_cast<int>(row), cells_ - 2);
  const double s = column - i, t = row - j;
  const float* low = &difference_k_[static_cast<std::size_t>(j) * static_cast<std::size_t>(cells_) +
                                    static_cast<std::size_t>(i)];
  const float* high = low + cells_;
  return (1.0 - t) * ((1.0 - s) * static_cast<double>(low[0]) + s * static_cast<double>(low[1])) +
         t * ((1.0 - s) * static_cast<double>(high[0]) + s * static_cast<double>(high[1]));
}

void TextureMap::write(const std::filesystem::path& folder, const std::string& name, double mean_k) const {
  static_assert(std::endian::native == std::endian::little);
  std::vector<float> kelvins(difference_k_);
  for (float& v : kelvins) v += static_cast<float>(mean_k);
  write_file(folder / (name + ".img"),
             {reinterpret_cast<const char*>(kelvins.data()), kelvins.size() * sizeof(float)});
  write_file(
      folder / (name + ".hdr"),
      format("ENVI\nsamples = {}\nlines = {}\nbands = 1\nheader offset = 0\nfile type = ENVI Standard\n"
             "data type = 4\ninterleave = bsq\nbyte order = 0\n",
             cells_, cells_));
}

}  // namespace ifov::studies
