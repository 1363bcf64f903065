#include "transport/sky/sky_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ifov::transport {
namespace {

/// Over the second differences: twice what a parabola's hump has above nodes of equal steps.
constexpr float kBeyond = 0.25f;

constexpr auto kParts = static_cast<std::size_t>(kSkyRefinement);

/// Four rows, what they weigh, and which two lie beside the direction.
struct Cubic {
  std::array<std::size_t, 4> row{};
  std::array<float, 4> weight{}, sign{1.0f, 1.0f, 1.0f, 1.0f};
  std::size_t below = 1;

  float at(const std::array<const float*, 4>& rows, std::size_t n) const {
    std::array<float, 4> values{};
    float sum = 0.0f;
    for (std::size_t k = 0; k < 4; ++k) values[k] = sign[k] * rows[k][n], sum += weight[k] * values[k];
    const auto [low, high] = std::minmax(values[below], values[below + 1]);
    const float first = values[0] - 2.0f * values[1] + values[2],
                second = values[1] - 2.0f * values[2] + values[3];
    const float beyond = first * second > 0.0f ? kBeyond * std::min(std::abs(first), std::abs(second)) : 0.0f;
    return std::clamp(sum, low - beyond, high + beyond);
  }
};

void weigh(const std::array<double, 4>& at, double x, Cubic& cubic) {
  for (std::size_t k = 0; k < 4; ++k) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != k) weight *= (x - at[j]) / (at[k] - at[j]);
    cubic.weight[k] = static_cast<float>(weight);
  }
}

/// `mirrored`: both ends are planes of symmetry; else the polynomial of the last four nodes holds there.
std::vector<Cubic> cubics(const std::vector<double>& nodes, bool mirrored, float sign) {
  const std::size_t last = nodes.size() - 1;
  std::vector<Cubic> all;
  for (std::size_t low = 0; low < last; ++low)
    for (std::size_t part = 0; part < kParts; ++part) {
      Cubic cubic;
      std::array<double, 4> at{};
      // The first node's number, which may be -1 where nodes are mirrored.
      const std::size_t shift = mirrored ? low : std::clamp<std::size_t>(low, 1, last - 2);
      cubic.below = low + 1 - shift;
      for (std::size_t k = 0; k < 4; ++k) {
        std::size_t row = shift + k;  // one more than the node's number
        if (row == 0)
          row = 2, at[k] = 2.0 * nodes[0] - nodes[1], cubic.sign[k] = sign;
        else if (row > last + 1)
          row = last, at[k] = 2.0 * nodes[last] - nodes[last - 1], cubic.sign[k] = sign;
        else
          at[k] = nodes[row - 1];
        cubic.row[k] = row - 1;
      }
      const double share = static_cast<double>(part) / static_cast<double>(kParts);
      weigh(at, nodes[low] + share * (nodes[low + 1] - nodes[low]), cubic);
      all.push_back(cubic);
    }
  return all;
}

std::vector<double> refined(const std::vector<double>& nodes) {
  std::vector<double> finer;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    for (std::size_t part = 0; part < kParts; ++part)
      finer.push_back(nodes[k] +
                      static_cast<double>(part) / static_cast<double>(kParts) * (nodes[k + 1] - nodes[k]));
  finer.push_back(nodes.back());
  return finer;
}

}  // namespace

SkyGrid refined(const SkyGrid& grid) { return {refined(grid.zenith_rad), refined(grid.azimuth_rad)}; }

radiometry::SpectrumBlock refined(const SkyGrid& grid, const radiometry::SpectrumBlock& spectra, float sign) {
  const std::size_t azimuths = grid.azimuth_rad.size(), columns = spectra.columns();
  const SkyGrid finer = refined(grid);
  const std::size_t fine_azimuths = finer.azimuth_rad.size();
  const std::vector<Cubic> by_zenith = cubics(grid.zenith_rad, false, 1.0f),
                           by_azimuth = cubics(grid.azimuth_rad, true, sign);
  radiometry::SpectrumBlock rings(finer.zenith_rad.size() * azimuths, columns),
      result(finer.zenith_rad.size() * fine_azimuths, columns);
  const auto fill = [columns](const radiometry::SpectrumBlock& from, const Cubic& cubic, std::size_t first,
                              std::size_t step, float* into) {
    std::array<const float*, 4> rows{};
    for (std::size_t k = 0; k < 4; ++k) rows[k] = from.row(first + step * cubic.row[k]);
    for (std::size_t n = 0; n < columns; ++n) into[n] = cubic.at(rows, n);
  };
  for (std::size_t z = 0; z < finer.zenith_rad.size(); ++z)
    for (std::size_t a = 0; a < azimuths; ++a) {
      float* const into = rings.row(z * azimuths + a);
      if (z < by_zenith.size())
        fill(spectra, by_zenith[z], a, azimuths, into);
      else
        std::copy_n(spectra.row((grid.zenith_rad.size() - 1) * azimuths + a), columns, into);
    }
  for (std::size_t z = 0; z < finer.zenith_rad.size(); ++z)
    for (std::size_t a = 0; a < fine_azimuths; ++a) {
      float* const into = result.row(z * fine_azimuths + a);
      if (a < by_azimuth.size())
        fill(rings, by_azimuth[a], z * azimuths, 1, into);
      else
        std::copy_n(rings.row(z * azimuths + azimuths - 1), columns, into);
    }
  return result;
}

}  // namespace ifov::transport
