#include <algorithm>
#include <cmath>

#include "radiometry/spectral_nodes.h"
#include "render/field/scene_field.h"
#include "render/parts/part_columns.h"
#include "render/polarized/scene_light.h"
#include "sampling/image/levels.h"
#include "sensor/camera.h"
#include "transport/path_tracer.h"
#include "transport/spectral_scene.h"

namespace ifov::render {

namespace {

/// As in scene_field.cpp, and whole fours.
constexpr std::size_t kLevelGroup = 512;

/// Variances of channels from those of their nodes, which vary together: a channel's standard deviation is at most the weighted sum
/// of theirs, and hardly less, because the nodes of one channel are alike.
void variance_to_channels(const radiometry::SpectralNodes& nodes, float* in_nodes, float* channels) {
  for (std::size_t n = 0; n < nodes.node_count(); ++n) in_nodes[n] = std::sqrt(in_nodes[n]);
  nodes.to_channels(in_nodes, channels);
  for (std::size_t c = 0; c < nodes.channel_count(); ++c) channels[c] *= channels[c];
}

}  // namespace

void SceneField::levels(const sampling::LevelRequests& of, sampling::LevelSums& sums) {
  // Values that weigh unlike by channel are no sums of spectra; those of what moves have times of their own.
  if (light_->polarized() || !of.importance.empty() || moving_ != nullptr || flown_ != nullptr)
    return Field::levels(of, sums);
  const radiometry::SpectralNodes& nodes = scene_.nodes();
  const std::size_t row_length = static_cast<std::size_t>(stride()), in_nodes = scene_.stride(),
                    channels = nodes.channel_count(), others = static_cast<std::size_t>(columns()) - channels;
  for (std::vector<float>* rows : {&sums.direct, &sums.direct_variance, &sums.rest, &sums.rest_variance})
    rows->assign(of.counts.size() * row_length, 0.0f);
  sums.labels.resize(of.requests.size());
  sums.label_weights.clear();
  sampling::LevelAccumulator spectra(in_nodes), beside(others);
  // Parts add up to what they are parts of to the last digits only where no sum of many values rounds them off.
  const PartColumns& parts = light_->columns().parts();
  const std::size_t in_parts = parts.told() ? channels + parts.count() : 0;
  sampling::LevelAccumulatorIn<double> exact(in_parts);
  std::vector<float> means(in_parts), variances(in_parts), rest_means(in_parts), rest_variances(in_parts);
  std::vector<float> mean(in_nodes), variance(in_nodes), rest_mean(in_nodes), rest_variance(in_nodes);
  std::vector<float> shares(row_length), rest_shares(row_length);
  std::size_t group = 0, in_group = 0;
  const auto finish = [&] {
    float* const rows[] = {
        sums.direct.data() + group * row_length, sums.direct_variance.data() + group * row_length,
        sums.rest.data() + group * row_length, sums.rest_variance.data() + group * row_length};
    spectra.take(mean.data(), variance.data(), rest_mean.data(), rest_variance.data());
    nodes.to_channels(mean.data(), rows[0]);
    variance_to_channels(nodes, variance.data(), rows[1]);
    nodes.to_channels(rest_mean.data(), rows[2]);
    variance_to_channels(nodes, rest_variance.data(), rows[3]);
    if (others > 0)
      beside.take(rows[0] + channels, rows[1] + channels, rows[2] + channels, rows[3] + channels);
    if (in_parts > 0) {
      exact.take(means.data(), variances.data(), rest_means.data(), rest_variances.data());
      std::copy(means.begin(), means.end(), rows[0]);
      std::copy(variances.begin() + static_cast<std::ptrdiff_t>(channels), variances.end(),
                rows[1] + channels);
      std::copy(rest_means.begin(), rest_means.end(), rows[2]);
      std::copy(rest_variances.begin() + static_cast<std::ptrdiff_t>(channels), rest_variances.end(),
                rows[3] + channels);
      exact.clear();
    }
    spectra.clear();
    beside.clear();
    ++group;
    in_group = 0;
  };
  for (std::size_t first = 0; first < of.requests.size(); first += kLevelGroup) {
    const std::size_t count = std::min(kLevelGroup, of.requests.size() - first);
    points_.resize(count);
    keys_.resize(count);
    rays_.resize(count);
    hits_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      points_[k] = of.requests[first + k].point;
      keys_[k] = {of.requests[first + k].sequence, of.requests[first + k].index};
    }
    camera_.rays(points_, rays_);
    const std::span<const std::uint8_t> whole = of.whole.subspan(first, count);
    const transport::PathRecord& paths = tracer_->trace(rays_, keys_, hits_, counts_, whole);
    for (std::size_t k = 0; k < count; ++k) {
      const SceneLight::Levels light = light_->levels(paths, k, whole[k] != 0);
      spectra.add_direct(light.direct);
      if (light.rest != nullptr) spectra.add_rest(light.rest);
      if (others > 0) {
        // Shares of materials are known where a path begins, and light that is not sought where it ends.
        std::fill(shares.begin(), shares.end(), 0.0f);
        std::fill(rest_shares.begin(), rest_shares.end(), 0.0f);
        if (in_parts > 0) {
          nodes.to_channels(light.direct, shares.data());
          if (light.rest != nullptr) nodes.to_channels(light.rest, rest_shares.data());
          light_->write_parts(paths, k, light.rest != nullptr, shares.data(), rest_shares.data());
          exact.add_direct(shares.data());
          if (light.rest != nullptr) exact.add_rest(rest_shares.data());
        }
        if (blends_.count() > 0) blends_.write_shares(hits_[k], shares.data());
        beside.add_direct(shares.data() + channels);
        if (light.rest != nullptr) {
          unseen_.write(paths.paths[k], rest_shares.data());
          beside.add_rest(rest_shares.data() + channels);
        }
      }
      SurfaceLabel label;
      label.material = SurfaceLabel::kSky;
      if (const geometry::SurfacePoint& hit = hits_[k]; hit.hit())
        label = {hit.instance, hit.patch,
                 blends_.mixes(hit.material) ? SurfaceLabel::kBlend
                                             : truth_.of_material[paths.paths[k].seen_material],
                 hit.front, SunState::none};
      sums.labels[first + k] = label.pack();
      if (++in_group == of.counts[group]) finish();
    }
  }
}

}  // namespace ifov::render
