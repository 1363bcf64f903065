#include "radiometry/spectral_nodes.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "radiometry/channel_grid.h"
#include "radiometry/node_rule.h"
#include "radiometry/node_search.h"
#include "radiometry/spectrum_walk.h"

namespace ifov::radiometry {
namespace {

/// Numbers that no sensor sees become 0, because denormal floats would slow every product.
float flushed(double value) { return std::abs(value) < 1e-30 ? 0.0f : static_cast<float>(value); }

/// Grey surfaces vary with nothing; where whole radiances are judged, the darkest and the brightest of them show the most
/// of what the air and they themselves send.
std::vector<std::vector<double>> judged_surfaces(const ChannelGrid& grid, std::span<const Spectrum> surfaces,
                                                 const NodeDemands& demands) {
  std::vector<std::vector<double>> sampled;
  const Spectrum *darkest = nullptr, *brightest = nullptr;
  const auto value = [&](const Spectrum* grey) { return grey->at(grid.wavelength_um.front()); };
  for (const Spectrum& surface : surfaces) {
    if (!surface.is_constant()) {
      sampled.push_back(grid.sampled(surface));
      continue;
    }
    if (darkest == nullptr || value(&surface) < value(darkest)) darkest = &surface;
    if (brightest == nullptr || value(&surface) > value(brightest)) brightest = &surface;
  }
  if (demands.all_glow && darkest != nullptr) sampled.push_back(grid.sampled(*darkest));
  if (demands.all_glow && brightest != darkest) sampled.push_back(grid.sampled(*brightest));
  return sampled;
}

/// Rules of channels by `find`, in parallel.
template <class Find>
std::vector<std::optional<FoundRule>> found_rules(std::size_t channels, const Find& find) {
  std::vector<std::optional<FoundRule>> found(channels);
  std::vector<std::exception_ptr> failed(channels);  // what is told does not depend on threads
  parallel_for(static_cast<std::int64_t>(channels), 0, [&](std::int64_t k) {
    const auto channel = static_cast<std::size_t>(k);
    try {
      found[channel] = find(channel);
    } catch (...) {
      failed[channel] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  return found;
}

}  // namespace

SpectralNodes SpectralNodes::build(std::span<const Channel> channels, const Spectrum& solar_irradiance,
                                   std::span<const Spectrum> surfaces, const NodeDemands& demands,
                                   const Spectrum* sky_radiance) {
  SpectralNodes result;
  for (std::optional<FoundRule>& rule : found_rules(channels.size(), [&](std::size_t k) {
         const ChannelGrid grid(channels[k], solar_irradiance, surfaces, sky_radiance, demands.lamps);
         return find_rule(grid, judged_surfaces(grid, surfaces, demands), demands);
       }))
    result.add(std::move(*rule));
  result.arrange_sums();
  return result;
}

SpectralNodes SpectralNodes::build(std::span<const ChannelGrid> channels, std::span<const Spectrum> surfaces,
                                   const NodeDemands& demands) {
  SpectralNodes result;
  for (std::optional<FoundRule>& rule : found_rules(channels.size(), [&](std::size_t k) {
         return find_rule(channels[k], judged_surfaces(channels[k], surfaces, demands), demands);
       }))
    result.add(std::move(*rule));
  result.arrange_sums();
  return result;
}

SpectralNodes::SpectralNodes() = default;
SpectralNodes::SpectralNodes(SpectralNodes&&) noexcept = default;
SpectralNodes& SpectralNodes::operator=(SpectralNodes&&) noexcept = default;
SpectralNodes::~SpectralNodes() = default;

void SpectralNodes::add(FoundRule found) {
  worst_error_ = std::max(worst_error_, found.worst_error);
  channel_error_.push_back(found.worst_error);
  for (std::size_t node = 0; node < found.rule.node_count(); ++node) {
    weight_.push_back(static_cast<float>(found.rule.weight(node)));
    wavelength_um_.push_back(found.rule.wavelength_um(node));
  }
  first_node_.push_back(weight_.size());
  rules_.push_back(std::move(found.rule));
}

void SpectralNodes::arrange_sums() {
  if (node_count() == channel_count()) return;
  for (std::size_t first = 0; first < channel_count(); first += kLanes) {
    const std::size_t last = std::min(first + kLanes, channel_count());
    std::size_t depth = 0;
    for (std::size_t channel = first; channel < last; ++channel)
      depth = std::max(depth, rules_[channel].node_count());
    slices_.push_back({slice_weight_.size(), depth});
    for (std::size_t level = 0; level < depth; ++level)
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        // Where a channel has fewer nodes, its first one with no weight.
        const std::size_t channel = std::min(first + lane, channel_count() - 1);
        const bool used = first + lane < last && level < rules_[channel].node_count();
        const std::size_t node = first_node_[channel] + (used ? level : 0);
        slice_weight_.push_back(used ? weight_[node] : 0.0f);
        slice_node_.push_back(static_cast<std::int32_t>(node));
      }
  }
}

template <class Project>
void SpectralNodes::for_each_rule(std::span<float> nodes, const Project& project) const {
  std::vector<double> at_points, at_nodes;
  for (std::size_t channel = 0; channel < rules_.size(); ++channel) {
    const NodeRule& rule = rules_[channel];
    at_points.resize(rule.grid_um().size());
    at_nodes.resize(rule.node_count());
    project(rule, at_points, at_nodes);
    std::transform(at_nodes.begin(), at_nodes.end(),
                   nodes.begin() + static_cast<std::ptrdiff_t>(first_node_[channel]),
                   [](double value) { return flushed(value); });
  }
}

void SpectralNodes::average_surface(const Spectrum& spectrum, std::span<float> nodes) const {
  for_each_rule(nodes,
                [&](const NodeRule& rule, std::vector<double>& at_points, std::vector<double>& at_nodes) {
                  sample(spectrum, rule.grid_um(), at_points);
                  rule.project_factor(at_points, at_nodes);
                });
}

void SpectralNodes::average_source(const Spectrum& spectrum, std::span<float> nodes) const {
  const Spectrum* product[] = {&spectrum};
  average_source(product, nodes);
}

void SpectralNodes::average_source(std::span<const Spectrum* const> product, std::span<float> nodes) const {
  for_each_rule(nodes,
                [&](const NodeRule& rule, std::vector<double>& at_points, std::vector<double>& at_nodes) {
                  std::vector<double> values(at_points.size());
                  std::fill(at_points.begin(), at_points.end(), 1.0);
                  for (const Spectrum* factor : product) {
                    sample(*factor, rule.grid_um(), values);
                    for (std::size_t q = 0; q < values.size(); ++q) at_points[q] *= values[q];
                  }
                  rule.project_source(at_points, at_nodes);
                });
}

void SpectralNodes::average_factor(std::size_t channel, std::span<const double> at_points,
                                   std::span<double> nodes) const {
  rules_[channel].project_factor(at_points, nodes);
}

void SpectralNodes::average_seen(std::size_t channel, std::span<const double> at_points,
                                 std::span<double> nodes) const {
  rules_[channel].project_seen(at_points, nodes);
}

void SpectralNodes::average_source(std::size_t channel, std::span<const double> at_points,
                                   std::span<double> nodes) const {
  rules_[channel].project_source(at_points, nodes);
}

void SpectralNodes::planck(double temperature_k, std::span<float> nodes) const {
  for_each_rule(nodes, [&](const NodeRule& rule, std::vector<double>&, std::vector<double>& at_nodes) {
    rule.project_planck(temperature_k, at_nodes);
  });
}

void SpectralNodes::planck(double temperature_k, std::span<double> nodes) const {
  for (std::size_t channel = 0; channel < rules_.size(); ++channel)
    rules_[channel].project_planck(temperature_k,
                                   nodes.subspan(first_node_[channel], rules_[channel].node_count()));
}

void SpectralNodes::planck_channels(double temperature_k, std::span<double> channels) const {
  std::vector<double> nodes(node_count());
  planck(temperature_k, std::span<double>(nodes));
  for (std::size_t channel = 0; channel < rules_.size(); ++channel) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rules_[channel].node_count(); ++i)
      sum += rules_[channel].weight(i) * nodes[first_node_[channel] + i];
    channels[channel] = sum;
  }
}

void SpectralNodes::to_channels(const float* nodes, float* channels) const {
  if (slices_.empty()) {
    std::copy(nodes, nodes + node_count(), channels);
    return;
  }
  std::size_t first = 0;
  for (const Slice& slice : slices_) {
    const float* weight = slice_weight_.data() + slice.first_entry;
    const std::int32_t* node = slice_node_.data() + slice.first_entry;
    float lanes[kLanes] = {};
#ifdef __AVX2__
    // Written out, because the compiler makes eight single loads of a gather, which take twice as long.
    __m256 sum = _mm256_setzero_ps();
    for (std::size_t level = 0; level < slice.depth; ++level, weight += kLanes, node += kLanes) {
      const __m256i index = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(node));
      sum = _mm256_add_ps(sum, _mm256_mul_ps(_mm256_loadu_ps(weight), _mm256_i32gather_ps(nodes, index, 4)));
    }
    _mm256_storeu_ps(lanes, sum);
#else
    for (std::size_t level = 0; level < slice.depth; ++level, weight += kLanes, node += kLanes)
      for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += weight[lane] * nodes[node[lane]];
#endif
    std::copy(lanes, lanes + std::min(kLanes, channel_count() - first), channels + first);
    first += kLanes;
  }
}

}  // namespace ifov::radiometry
