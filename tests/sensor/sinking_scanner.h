#pragma once

#include <cmath>

#include "sensor/camera.h"

namespace ifov::test {

/// Scans one line after the other from an aircraft that flies north and sinks.
class SinkingScanner final : public sensor::Camera {
 public:
  static constexpr double kLine_s = 0.01, kSpeed_m_s = 80.0, kSink_m_s = 10.0, kStep_rad = 1e-3;
  int width_px() const override { return 50; }
  int height_px() const override { return 400; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const sensor::CameraPose at = pose(points[i].y_px);
      const double across = (points[i].x_px - 25.0) * kStep_rad;
      rays[i] = {.origin_m = *at.position_m,
                 .direction = {std::sin(across), 0.0, -std::cos(across)},
                 .time_s = at.time_s + points[i].time_s};
    }
  }
  bool project(math::Point3, sampling::FocalPoint&) const override { return false; }
  double gsd_m(math::Point3 position_m) const override {
    return kStep_rad * (pose(position_m.y / (kSpeed_m_s * kLine_s)).position_m->z - position_m.z);
  }
  sensor::CameraPose pose(double line_px) const override {
    const double t = line_px * kLine_s;
    return {{}, math::Point3{0.0, kSpeed_m_s * t, 1000.0 - kSink_m_s * t}, 0.0, 0.0, t};
  }
  std::optional<sensor::GroundGrid> ground_grid() const override { return std::nullopt; }
};

}  // namespace ifov::test
