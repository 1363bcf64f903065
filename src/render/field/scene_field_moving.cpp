#include <algorithm>

#include "render/field/scene_field.h"
#include "render/moving/flown_exposure.h"
#include "render/moving/moving_cover.h"
#include "sensor/camera.h"

// What points show where something moves while they are exposed, the camera or what it sees.

namespace ifov::render {

std::shared_ptr<MovingCover> SceneField::find_moving(const scene::Scene& scene,
                                                     const sensor::Camera& camera) {
  return MovingCover::find(scene, camera);
}

std::shared_ptr<FlownExposure> SceneField::find_flown(const scene::Scene& scene,
                                                      const sensor::Camera& camera) {
  return FlownExposure::find(scene, camera);
}

std::vector<double> SceneField::instants_s() const {
  return flown_ != nullptr ? flown_->instants_s() : std::vector<double>{};
}

void SceneField::find_covered(std::span<const sampling::FocalPoint> points) {
  if (moving_ == nullptr) return;
  covered_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    covered_[k] = moving_->covers(points[k], rays_[k], hits_[k]);
    if (covered_[k] != 0 || !through_.any()) continue;
    geometry::SurfacePoint last = hits_[k];
    ways_.clear();
    through_.list_ways(rays_[k], moving_->still(), last, ways_, counts_);
    covered_[k] = std::any_of(ways_.begin(), ways_.end(), [&](const math::Ray& way) {
      return moving_->shades(points[k], rays_[k], way, 0.0);
    });
  }
}

void SceneField::moving_values(std::span<const sampling::PathRequest> requests,
                               std::span<sampling::Label> labels, std::span<float> values,
                               LabelDetail detail) {
  constexpr std::size_t kTogether = kMostTraced / 2;
  const std::size_t row_length = static_cast<std::size_t>(stride());
  std::vector<sampling::PathRequest> asked;
  std::vector<float> shares(kTogether), row(row_length);
  std::vector<sampling::Label> met;
  for (std::size_t first = 0; first < requests.size(); first += kTogether) {
    const std::span<const sampling::PathRequest> group =
        requests.subspan(first, std::min(kTogether, requests.size() - first));
    points_.resize(group.size()), rays_.resize(group.size()), hits_.resize(group.size());
    for (std::size_t k = 0; k < group.size(); ++k) points_[k] = group[k].point;
    camera_.rays(points_, rays_);
    moving_->meet_still(rays_, hits_);
    counts_.primary += group.size();
    asked.clear();
    for (std::size_t k = 0; k < group.size(); ++k) {
      geometry::SurfacePoint last = hits_[k];
      ways_.clear();
      if (through_.any()) through_.list_ways(rays_[k], moving_->still(), last, ways_, counts_);
      const MovingCover::Times times = moving_->times(group[k], rays_[k], hits_[k], ways_, last);
      shares[k] = static_cast<float>(times.share);
      for (const bool meeting : {true, false}) {
        if (shares[k] == (meeting ? 0.0f : 1.0f)) continue;
        asked.push_back(group[k]);
        asked.back().point.time_s += meeting ? times.met_s : times.else_s;
      }
    }
    const transport::PathRecord& paths = trace_paths(asked);
    for (std::size_t k = 0, j = 0; k < group.size(); ++k) {
      float* const value = values.data() + (first + k) * row_length;
      write(*this, paths, j++, value);
      if (shares[k] == 0.0f || shares[k] == 1.0f) continue;
      write(*this, paths, j++, row.data());
      for (std::size_t c = 0; c < row_length; ++c)
        value[c] = shares[k] * value[c] + (1.0f - shares[k]) * row[c];
    }
    met.resize(asked.size());
    label_hits(points_, hits_, detail, met);
    for (std::size_t k = 0, j = 0; k < group.size(); ++k) {
      labels[first + k] = met[j];
      j += shares[k] == 0.0f || shares[k] == 1.0f ? 1 : 2;
    }
  }
}

void SceneField::flown_labels(std::span<const sampling::FocalPoint> points, LabelDetail detail,
                              std::span<sampling::Label> labels) {
  const std::vector<double>& instants_s = flown_->instants_s();
  const std::size_t instants = instants_s.size(), together = std::max<std::size_t>(1, kMostTraced / instants);
  std::vector<sampling::Label> shown;
  for (std::size_t first = 0; first < points.size(); first += together) {
    const std::size_t count = std::min(together, points.size() - first);
    points_.resize(count * instants), rays_.resize(count * instants), hits_.resize(count * instants);
    shown.resize(count * instants);
    for (std::size_t k = 0; k < count * instants; ++k) {
      points_[k] = points[first + k / instants];
      points_[k].time_s = instants_s[k % instants];
    }
    meet(points_);
    label_hits(points_, hits_, detail, shown);
    for (std::size_t k = 0; k < count; ++k) {
      const auto own = std::span(shown).subspan(k * instants, instants);
      const bool alike =
          std::all_of(own.begin(), own.end(), [&](sampling::Label one) { return one == own[0]; });
      labels[first + k] = alike && !flown_->crossed(points[first + k]) ? own[0] : SurfaceLabel::moving();
    }
  }
}

void SceneField::flown_values(std::span<const sampling::PathRequest> requests,
                              std::span<sampling::Label> labels, std::span<float> values, LabelDetail detail,
                              std::span<const sampling::Label> expected) {
  constexpr std::size_t kTogether = kMostTraced / 2;
  const std::size_t row_length = static_cast<std::size_t>(stride());
  std::vector<sampling::PathRequest> asked;
  std::vector<std::size_t> first_of(kTogether + 1), unsure;
  std::vector<float> shares(kTogether), row(row_length);
  std::vector<sampling::Label> met, found;
  std::vector<sampling::FocalPoint> points;
  for (std::size_t first = 0; first < requests.size(); first += kTogether) {
    const std::span<const sampling::PathRequest> group =
        requests.subspan(first, std::min(kTogether, requests.size() - first));
    asked.clear();
    for (std::size_t k = 0; k < group.size(); ++k) {
      const MovingCover::Times times = flown_->times(group[k]);
      shares[k] = static_cast<float>(times.share);
      first_of[k] = asked.size();
      for (const bool meeting : {true, false}) {
        if (shares[k] == (meeting ? 0.0f : 1.0f)) continue;
        asked.push_back(group[k]);
        asked.back().point.time_s += meeting ? times.met_s : times.else_s;
      }
    }
    first_of[group.size()] = asked.size();
    const transport::PathRecord& paths = trace_paths(asked);
    met.resize(asked.size());
    covered_.assign(asked.size(), 1);
    unsure.clear(), points.clear();
    if (detail == LabelDetail::material) {
      // Whatever they show, their shares are told path by path.
      std::fill_n(labels.begin() + static_cast<std::ptrdiff_t>(first), group.size(), SurfaceLabel::moving());
    } else {
      label_hits(points_, hits_, detail, met);
      for (std::size_t k = 0; k < group.size(); ++k) {
        sampling::Label& label = labels[first + k];
        label = SurfaceLabel::moving();
        if (!expected.empty() && expected[first + k] == label) continue;
        const auto own = std::span(met).subspan(first_of[k], first_of[k + 1] - first_of[k]);
        const bool as_expected = !expected.empty() && std::all_of(own.begin(), own.end(), [&](auto one) {
          return one == expected[first + k];
        });
        if (as_expected) {
          label = own[0];
          covered_[first_of[k]] = covered_[first_of[k + 1] - 1] = 0;
        } else {
          unsure.push_back(k);
          points.push_back(group[k].point);
        }
      }
    }
    if (!unsure.empty()) {
      // Their rays are others; those of the paths are kept.
      auto own_points = std::move(points_);
      auto own_rays = std::move(rays_);
      auto own_hits = std::move(hits_);
      found.resize(points.size());
      flown_labels(points, detail, found);
      points_ = std::move(own_points), rays_ = std::move(own_rays), hits_ = std::move(own_hits);
      for (std::size_t j = 0; j < unsure.size(); ++j) {
        const std::size_t k = unsure[j];
        if (found[j] == SurfaceLabel::moving()) continue;
        labels[first + k] = met[first_of[k]];
        covered_[first_of[k]] = covered_[first_of[k + 1] - 1] = 0;
      }
    }
    for (std::size_t k = 0; k < group.size(); ++k) {
      float* const value = values.data() + (first + k) * row_length;
      write(*this, paths, first_of[k], value);
      if (first_of[k + 1] - first_of[k] == 1) continue;
      write(*this, paths, first_of[k] + 1, row.data());
      for (std::size_t c = 0; c < row_length; ++c)
        value[c] = shares[k] * value[c] + (1.0f - shares[k]) * row[c];
    }
  }
}

}  // namespace ifov::render
