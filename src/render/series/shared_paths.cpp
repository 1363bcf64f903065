#include "render/series/shared_paths.h"

#include <algorithm>
#include <bit>

#include "sampling/random.h"
#include "scene/temperature_scope.h"
#include "transport/path_record.h"

namespace ifov::render {
namespace {

constexpr double kHandle_k = 1e6;  // no surface is as warm

/// The rays of a path, as far as its record tells them: one to each surface and to the sky, and those that found an emitter.
sampling::RayCounts rays_of(const transport::PathRecord& paths, std::size_t k) {
  sampling::RayCounts rays;
  std::uint32_t path = static_cast<std::uint32_t>(k);
  for (bool first = true; path != transport::PathVertex::kNone;
       path = paths.paths[path].also, first = false) {
    std::uint64_t segments = paths.paths[path].escaped ? 1 : 0;
    for (std::uint32_t v = paths.paths[path].first; v != transport::PathVertex::kNone;
         v = paths.vertices[v].next) {
      ++segments;
      if (paths.vertices[v].sought_weight > 0.0f) ++rays.shadow;
    }
    if (first) rays.primary = 1;
    rays.continuation += segments > 0 ? segments - 1 : 0;
  }
  return rays;
}

}  // namespace

/// Notes the temperatures that paths meet at all times, and says which they were instead.
class SharedPaths::Handles final : public scene::TemperatureScope {
 public:
  explicit Handles(const scene::TemperaturesOfTimes& of) : of_(of), times_(of.times()) {}

  scene::EstimatedTemperature answer(std::size_t number, const geometry::SurfacePoint& point,
                                     std::uint64_t draw, double share) override {
    const std::size_t at = asked_.size();
    asked_.resize(at + times_);
    of_.at(number, point, draw, share, {asked_.data() + at, times_});
    return {kHandle_k + static_cast<double>(at / times_), 0.0};
  }
  /// The constituents that hold such an answer.
  void look_through(transport::PathRecord& paths) {
    for (std::size_t m = 0; m < paths.mixed.size(); ++m) {
      scene::ResolvedSurface& surface = paths.mixed[m].surface;
      for (std::size_t c = 0; c < surface.count; ++c)
        if (const double handle = surface.constituents[c].mapped_temperature_k - kHandle_k; handle >= 0.0)
          places_.push_back({m, c, static_cast<std::size_t>(handle)});
    }
  }
  /// The paths as of a time.
  void set(std::size_t time, transport::PathRecord& paths) const {
    for (const Place& place : places_) {
      const scene::EstimatedTemperature& one = asked_[place.asked * times_ + time];
      scene::Constituent& part = paths.mixed[place.mixed].surface.constituents[place.constituent];
      part.mapped_temperature_k = one.kelvin;
      part.deviation_k = one.deviation_k;
      part.else_k = static_cast<float>(one.else_k);
      part.times = static_cast<float>(one.times);
      part.else_deviation_k = static_cast<float>(one.else_deviation_k);
    }
  }

 private:
  struct Place {
    std::size_t mixed, constituent, asked;
  };
  const scene::TemperaturesOfTimes& of_;
  std::size_t times_;
  std::vector<scene::EstimatedTemperature> asked_;
  std::vector<Place> places_;
};

class SharedPaths::OfTime final : public SharedValues {
 public:
  OfTime(SharedPaths& all, std::size_t time) : all_(all), time_(time) {}
  void values(SceneField&, std::span<const sampling::PathRequest> requests, std::span<sampling::Label> labels,
              std::span<float> values) override {
    all_.values(time_, requests, labels, values);
  }

 private:
  SharedPaths& all_;
  std::size_t time_;
};

std::size_t SharedPaths::KeyHash::operator()(const Key& key) const {
  return sampling::hash(key.sequence, key.x, key.y, key.index);
}

SharedPaths::SharedPaths(SceneField& tracer, std::vector<SceneField*> fields,
                         const scene::TemperaturesOfTimes& temperatures, std::size_t most_bytes)
    : tracer_(tracer),
      fields_(std::move(fields)),
      temperatures_(temperatures),
      most_bytes_(most_bytes),
      columns_(static_cast<std::size_t>(tracer.columns())) {
  for (std::size_t t = 0; t < fields_.size(); ++t) of_time_.push_back(std::make_unique<OfTime>(*this, t));
}

SharedPaths::~SharedPaths() = default;

SharedValues& SharedPaths::of(std::size_t time) { return *of_time_[time]; }

void SharedPaths::find(std::size_t time, std::span<const sampling::PathRequest> requests, bool hold) {
  labels_.resize(count_ + requests.size());
  rays_.resize(count_ + requests.size());
  held_.resize((count_ + requests.size()) * fields_.size() * columns_);
  values_.resize(static_cast<std::size_t>(tracer_.stride()) + 64);
  transport::PathRecord paths;
  for (std::size_t first = 0; first < requests.size(); first += SceneField::kMostTraced) {
    const std::size_t count = std::min(SceneField::kMostTraced, requests.size() - first);
    const std::size_t number = count_ + first;
    Handles handles(temperatures_);
    paths = tracer_.trace(requests.subspan(first, count), {labels_.data() + number, count});
    handles.look_through(paths);
    for (std::size_t k = 0; k < count; ++k) rays_[number + k] = rays_of(paths, k);
    for (std::size_t t = time; t < (hold ? fields_.size() : time + 1); ++t) {
      if (fields_[t] == nullptr) continue;
      handles.set(t, paths);
      for (std::size_t k = 0; k < count; ++k) {
        fields_[t]->write(tracer_, paths, k, values_.data());
        std::copy_n(values_.data(), columns_, row(t, number + k));
      }
    }
  }
}

void SharedPaths::values(std::size_t time, std::span<const sampling::PathRequest> requests,
                         std::span<sampling::Label> labels, std::span<float> values) {
  missing_.clear();
  asked_.clear();
  const std::size_t bytes_each =
      fields_.size() * columns_ * sizeof(float) + sizeof(Key) + sizeof(sampling::RayCounts) + 48;
  const bool hold = (count_ + requests.size()) * bytes_each <= most_bytes_;
  for (const sampling::PathRequest& request : requests) {
    const Key key{request.sequence, std::bit_cast<std::uint64_t>(request.point.x_px),
                  std::bit_cast<std::uint64_t>(request.point.y_px), request.index};
    const auto next = static_cast<std::uint32_t>(count_ + missing_.size());
    std::uint32_t number = next;
    if (hold)
      number = number_.try_emplace(key, next).first->second;
    else if (const auto found = number_.find(key); found != number_.end())
      number = found->second;
    if (number == next) missing_.push_back(request);
    asked_.push_back(number);
  }
  if (!missing_.empty()) find(time, missing_, hold);
  if (hold) count_ += missing_.size();
  const auto row_length = static_cast<std::size_t>(tracer_.stride());
  sampling::RayCounts rays;
  for (std::size_t k = 0; k < requests.size(); ++k) {
    labels[k] = labels_[asked_[k]];
    rays += rays_[asked_[k]];
    std::copy_n(row(time, asked_[k]), columns_, values.data() + k * row_length);
  }
  fields_[time]->count(rays);
}

}  // namespace ifov::render
