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

/// A weather file of two cloudless days of June at 52 N, 5 E, by the hour, under an even wind.
class ClearDays {
 public:
  ClearDays(const std::string& name, double wind_m_s)
      : path_(std::filesystem::temp_directory_path() / format("ifov_{}_{}.csv", name, ::getpid())) {
    std::ofstream file(path_);
    file
        << "time,air_temperature_c,relative_humidity_pct,wind_speed_m_s,cloud_fraction,global_irradiance_w_m2\n";
    for (int hour = 0; hour <= 48; ++hour) {
      const double turn = std::numbers::pi / 12.0;
      const double height = 0.3134 + 0.5648 * std::cos(turn * (hour + 0.3 - 12.0));
      file << format("2026-06-{:02d}T{:02d}:00:00Z,{:.2f},60,{:g},0,{:.1f}\n", 20 + hour / 24, hour % 24,
                     18.0 - 5.0 * std::cos(turn * (hour - 3.0)), wind_m_s,
                     std::max(0.0, 1000.0 * height - 30.0));
    }
  }
  ~ClearDays() { std::filesystem::remove(path_); }
  ClearDays(const ClearDays&) = delete;
  ClearDays& operator=(const ClearDays&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace ifov::session
