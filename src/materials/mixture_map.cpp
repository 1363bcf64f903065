#include "materials/mixture_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace ifov::materials {

MixtureMap::MixtureMap(MapGrid grid, std::size_t bands, std::span<const float> shares) : NumberedMap(grid) {
  const std::size_t cells = grid_.cell_count();
  if (bands < 1 || bands > 0xffffu) throw InputError(format("a mixture map of {} bands", bands));
  check(grid_, shares.size() / bands, "a mixture map");
  if (cells > 0xffffffffu / kMost) throw InputError(format("a mixture map of {} cells is too large", cells));
  first_.reserve(cells + 1);
  std::vector<Part> found;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto fail = [&](const std::string& what) {
      const std::size_t width = static_cast<std::size_t>(grid_.width);
      throw InputError(
          format("the fractions at row {}, column {} {}", cell / width + 1, cell % width + 1, what));
    };
    found.clear();
    double sum = 0.0;
    for (std::size_t band = 0; band < bands; ++band) {
      const float share = shares[band * cells + cell];
      if (!(share >= 0.0f) || !std::isfinite(share))
        fail(format("include {:g} (band {}); they must be numbers from 0 on", share, band + 1));
      sum += static_cast<double>(share);
      if (share > 0.0f) found.push_back({static_cast<std::uint16_t>(band), share});
    }
    if (found.empty()) fail("are all 0");
    if (std::abs(sum - 1.0) > kTolerance) {
      report_.lowest_sum = report_.rescaled == 0 ? sum : std::min(report_.lowest_sum, sum);
      report_.highest_sum = report_.rescaled == 0 ? sum : std::max(report_.highest_sum, sum);
      ++report_.rescaled;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Part& a, const Part& b) { return a.share > b.share; });
    double kept = sum;
    if (found.size() > kMost) {
      kept = 0.0;
      for (std::size_t k = 0; k < kMost; ++k) kept += static_cast<double>(found[k].share);
      ++report_.shortened;
      report_.largest_loss = std::max(report_.largest_loss, 1.0 - kept / sum);
      found.resize(kMost);
    }
    first_.push_back(static_cast<std::uint32_t>(parts_.size()));
    for (const Part& part : found)
      parts_.push_back({part.index, static_cast<float>(static_cast<double>(part.share) / kept)});
  }
  first_.push_back(static_cast<std::uint32_t>(parts_.size()));
  find_blocks();
}

float MixtureMap::number(std::size_t cell) const {
  float sum = 0.0f;
  for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k)
    sum += parts_[k].share * static_cast<float>(parts_[k].index);
  return sum;
}

std::span<const MixtureMap::Part> MixtureMap::at(const MapPosition& position) const {
  const std::size_t cell = grid_.cell_at(position);
  return {parts_.data() + first_[cell], parts_.data() + first_[cell + 1]};
}

}  // namespace ifov::materials
