#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/solved_temperature.h"

namespace ifov::scene {

/// The solved temperatures of one scene at several times, of a point at all of them at once.
class TemperaturesOfTimes {
 public:
  virtual ~TemperaturesOfTimes() = default;
  virtual std::size_t times() const = 0;
  /// As SolvedTemperature::at of Scene::solved[number], by time: without bias at each, by rays that they share.
  virtual void at(std::size_t number, const geometry::SurfacePoint& point, std::uint64_t draw, double share,
                  std::span<EstimatedTemperature> by_time) const = 0;
};

/// While one stands, it answers in place of all solved temperatures that its thread asks scenes for.
class TemperatureScope {
 public:
  TemperatureScope();
  virtual ~TemperatureScope();
  TemperatureScope(const TemperatureScope&) = delete;
  TemperatureScope& operator=(const TemperatureScope&) = delete;

  virtual EstimatedTemperature answer(std::size_t number, const geometry::SurfacePoint& point,
                                      std::uint64_t draw, double share) = 0;
  static TemperatureScope* current();  ///< null: none

 private:
  TemperatureScope* outer_;
};

}  // namespace ifov::scene
