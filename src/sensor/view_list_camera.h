#pragma once

#include <memory>
#include <vector>

#include "sensor/single_views.h"

namespace ifov::sensor {

struct ViewList;

/// Single views side by side: pixel k of the one line is view k. What lies between pixels is nothing, so that each is sampled by
/// itself, through its own camera (view()); asked as a whole, it answers of rays alone.
class ViewListCamera final : public Camera {
 public:
  ViewListCamera(std::shared_ptr<const ViewList> list, std::vector<std::unique_ptr<const SingleView>> views);

  const ViewListCamera* view_list() const override { return this; }
  const SingleView& view(std::size_t k) const { return *views_[k]; }
  const std::shared_ptr<const ViewList>& list() const { return list_; }

  int width_px() const override { return static_cast<int>(views_.size()); }
  int height_px() const override { return 1; }
  void rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const override;
  bool project(math::Point3, sampling::FocalPoint&) const override { return false; }
  double gsd_m(math::Point3 position_m) const override;
  /// That of the view in the middle.
  CameraPose pose(double line_px) const override;
  std::optional<GroundGrid> ground_grid() const override { return std::nullopt; }

 private:
  std::shared_ptr<const ViewList> list_;
  std::vector<std::unique_ptr<const SingleView>> views_;
};

}  // namespace ifov::sensor
