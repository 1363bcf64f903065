#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scene/temperature_scope.h"

namespace ifov::render {

/// Temperatures of points that each time of a series asks for itself: found at all times when the first asks, and kept. One thread.
class TemperaturesByTime {
 public:
  explicit TemperaturesByTime(const scene::TemperaturesOfTimes& of)
      : of_(of), times_(of.times()), next_(of.times(), 0) {}

  /// Answers as of a time.
  class Scope final : public scene::TemperatureScope {
   public:
    Scope(TemperaturesByTime& all, std::size_t time) : all_(all), time_(time) {}
    scene::EstimatedTemperature answer(std::size_t number, const geometry::SurfacePoint& point,
                                       std::uint64_t draw, double share) override {
      return all_.at(number, point, draw, share, time_);
    }

   private:
    TemperaturesByTime& all_;
    std::size_t time_;
  };

 private:
  scene::EstimatedTemperature at(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t draw,
                                 double share, std::size_t time);

  const scene::TemperaturesOfTimes& of_;
  std::size_t times_;
  std::unordered_map<std::uint64_t, std::size_t> number_;  ///< by a hash of all that is asked
  std::vector<std::uint64_t> key_;                         ///< by number
  std::vector<std::size_t> next_;  ///< by time the number that is asked for next, if as before
  std::vector<scene::EstimatedTemperature> known_;
};

}  // namespace ifov::render
