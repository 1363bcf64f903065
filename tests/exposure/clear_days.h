#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "core/format.h"

namespace ifov::session {

/// A weather file of two days of June at 52 N, 5 E, by the hour.
class DaysOfJune {
 public:
  DaysOfJune(const DaysOfJune&) = delete;
  DaysOfJune& operator=(const DaysOfJune&) = delete;
  ~DaysOfJune() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 protected:
  /// `air_c` and `sun_w_m2` of an hour of the day.
  template <class Air, class Sun>
  DaysOfJune(const std::string& name, double wind_m_s, const Air& air_c, const Sun& sun_w_m2)
      : path_(std::filesystem::temp_directory_path() / format("ifov_{}_{}.csv", name, ::getpid())) {
    std::ofstream file(path_);
    file
        << "time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2\n";
    for (int hour = 0; hour <= 48; ++hour)
      file << format("2026-06-{:02d}T{:02d}:00:00Z,{:.2f},60,{:g},0,{:.1f}\n", 20 + hour / 24, hour % 24,
                     air_c(hour), wind_m_s, sun_w_m2(hour));
  }

 private:
  std::filesystem::path path_;
};

/// Cloudless, under an even wind.
class ClearDays : public DaysOfJune {
 public:
  ClearDays(const std::string& name, double wind_m_s)
      : DaysOfJune(
            name, wind_m_s, [](int hour) { return 18.0 - 5.0 * std::cos(kHour_rad * (hour - 3.0)); },
            [](int hour) {
              const double height = 0.3134 + 0.5648 * std::cos(kHour_rad * (hour + 0.3 - 12.0));
              return std::max(0.0, 1000.0 * height - 30.0);
            }) {}

 private:
  static constexpr double kHour_rad = std::numbers::pi / 12.0;
};

/// Without sunlight, in air of 290 K that hardly moves.
class StillDays : public DaysOfJune {
 public:
  explicit StillDays(const std::string& name)
      : DaysOfJune(
            name, 1.0, [](int) { return 16.85; }, [](int) { return 0.0; }) {}
};

}  // namespace ifov::session
