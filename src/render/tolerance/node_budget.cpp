#include "render/tolerance/node_budget.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/tolerance/accuracy_tolerance.h"
#include "sampling/tile.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

std::vector<NodeHalfWidth> node_half_widths(const transport::SpectralScene& scene) {
  constexpr double kDarkShare = 0.01, kWarm_k = 300.0;  // as the nodes' checks have it (NodeDemands)
  const radiometry::SpectralNodes& nodes = scene.nodes();
  std::vector<double> white = scene.white_reflected(), warm(nodes.channel_count());
  nodes.planck_channels(kWarm_k, warm);
  std::vector<NodeHalfWidth> all;
  for (std::size_t c = 0; c < nodes.channel_count(); ++c)
    all.push_back({nodes.worst_error(c), kDarkShare * (white[c] + warm[c])});
  return all;
}

namespace {

/// The abundances of a tile pixel by pixel, asked for in order.
class HeldMaterials {
 public:
  explicit HeldMaterials(const sampling::TileResult& tile) : all_(tile.abundances) {}
  std::span<const sampling::Abundance> of(std::size_t pixel) {
    while (next_ < all_.size() && all_[next_].pixel < pixel) ++next_;
    const std::size_t first = next_;
    while (next_ < all_.size() && all_[next_].pixel == pixel) ++next_;
    return all_.subspan(first, next_ - first);
  }

 private:
  std::span<const sampling::Abundance> all_;
  std::size_t next_ = 0;
};

}  // namespace

double emitted_by(const NodeHalfWidth& node, const sampling::Abundance* held, std::size_t count) {
  constexpr double kRounding = 1e-4;
  if (node.emitted_of.empty() || count == 0) return node.emitted;
  const auto of = [&node](const sampling::Abundance& one) {
    return one.material < node.emitted_of.size() ? node.emitted_of[one.material] : node.emitted;
  };
  double sum = 0.0, known = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    sum += static_cast<double>(held[k].fraction) * of(held[k]);
    known += static_cast<double>(held[k].fraction);
  }
  const double rest = std::max(0.0, 1.0 - known);
  sum += rest * node.emitted;
  // Where all of a pixel is told, one material has more of it by what others have less: so shares move h by at most the sum of their
  // half-widths times |h - a|, whatever a is.
  const auto moved = [&](double a) {
    double by = 0.0;
    for (std::size_t k = 0; k < count; ++k)
      by += static_cast<double>(held[k].half_width) * std::abs(of(held[k]) - a);
    return by;
  };
  if (rest < kRounding)
    for (std::size_t k = 0; k < count; ++k) least = std::min(least, moved(of(held[k])));
  sum += std::min(least, moved(0.0));
  return std::isfinite(sum) ? std::min(sum, node.emitted) : node.emitted;
}

sampling::TileLayer empty_thermal_layer(std::size_t channels, const sampling::TileResult& tile) {
  return {kThermalLayer, sizeof(float), static_cast<std::uint32_t>(channels),
          std::vector<std::byte>(static_cast<std::size_t>(tile.tile.count()) * channels * sizeof(float))};
}

void add_thermal_layer(std::span<const NodeHalfWidth> nodes, sampling::TileResult& tile) {
  if (nodes.empty()) return;
  sampling::TileLayer layer = empty_thermal_layer(nodes.size(), tile);
  std::byte* into = layer.bytes.data();
  HeldMaterials materials(tile);
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    const std::span<const sampling::Abundance> held = materials.of(p);
    for (const NodeHalfWidth& node : nodes) {
      const float of_channel = static_cast<float>(emitted_by(node, held.data(), held.size()));
      std::memcpy(into, &of_channel, sizeof(float));
      into += sizeof(float);
    }
  }
  tile.layers.push_back(std::move(layer));
}

void widen(std::span<const NodeHalfWidth> nodes, const AccuracyTolerance* tolerance,
           sampling::TileResult& tile) {
  if (nodes.empty() || !tile.has_errors()) return;
  const std::size_t columns = static_cast<std::size_t>(tile.columns);
  std::vector<double> mean(columns), limit(columns, 0.0);
  const std::size_t channels = nodes.size();  // behind them Q, U and V, which err as I does
  HeldMaterials materials(tile);
  const sampling::BoundedError& joint = joint_of(tolerance);
  for (std::size_t p = 0; p < tile.samples.size(); ++p) {
    const std::span<const sampling::Abundance> held = materials.of(p);
    for (std::size_t c = 0; c < columns; ++c) mean[c] = tile.mean[p * columns + c];
    if (tolerance != nullptr) tolerance->asked(mean, limit);
    double worst = 0.0;
    bool wider = false;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t channel = c % channels;
      const double more = nodes[channel].counted(
          std::abs(mean[channel]), std::isinf(limit[c]) ? 0.0 : limit[c],
          nodes[channel].emitted - emitted_by(nodes[channel], held.data(), held.size()));
      tile.add_bound(p * columns + c, more);
      const double ratio = tile.joined(p * columns + c, joint) / limit[c];
      worst = std::max(worst, std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio);
      wider = wider || more > 0.0;
    }
    if (tolerance == nullptr || !wider) continue;
    tile.worst_ratio[p] = static_cast<float>(worst);
    constexpr double kRounding = 1e-5;
    if (worst > 1.0 + kRounding) tile.set(p, sampling::Reason::nodes);
  }
}

}  // namespace ifov::render
