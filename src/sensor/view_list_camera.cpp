#include "sensor/view_list_camera.h"

#include <algorithm>
#include <cmath>

namespace ifov::sensor {

ViewListCamera::ViewListCamera(std::shared_ptr<const ViewList> list,
                               std::vector<std::unique_ptr<const SingleView>> views)
    : list_(std::move(list)), views_(std::move(views)) {}

void ViewListCamera::rays(std::span<const sampling::FocalPoint> points, std::span<math::Ray> rays) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double last = static_cast<double>(views_.size() - 1);
    const double k = std::clamp(std::floor(points[i].x_px), 0.0, last);
    sampling::FocalPoint own = points[i];
    own.x_px -= k;
    views_[static_cast<std::size_t>(k)]->rays({&own, 1}, {&rays[i], 1});
  }
}

double ViewListCamera::gsd_m(math::Point3 position_m) const { return views_.front()->gsd_m(position_m); }

CameraPose ViewListCamera::pose(double line_px) const { return views_[views_.size() / 2]->pose(line_px); }

}  // namespace ifov::sensor
