#include <cmath>
#include <numbers>

#include "core/error.h"
#include "io/document/cameras/view_settings.h"
#include "io/document/cameras/view_table.h"
#include "math/angle.h"
#include "sampling/hash.h"
#include "sampling/random.h"
#include "sampling/warp.h"
#include "sensor/view_list.h"
#include "sensor/view_list_camera.h"

namespace ifov::io {
namespace {

using sensor::ViewList;

constexpr std::uint64_t kDirections = 0x68656d697370ull;  // purpose, in hash(seed, kDirections, cell, which)

sensor::AreaView::Settings area_of(const ViewedArea& area, const CameraSite& site) {
  sensor::AreaView::Settings settings;
  if (area.centre_m) {
    settings.centre_x_m = (*area.centre_m)[0] - site.offset_m.x;
    settings.centre_y_m = (*area.centre_m)[1] - site.offset_m.y;
  }
  const auto size = area.size_m ? area.size_m : site.period_m;
  if (!size)
    throw InputError(
        "the scene is not periodic, so that nothing says how large the area is: expected 'size', its extent from west to "
        "east and from south to north");
  settings.width_m = (*size)[0], settings.depth_m = (*size)[1];
  settings.height_m = area.height_m - site.offset_m.z;
  settings.start_height_m = std::max(site.highest_m, settings.height_m) + 1.0;
  return settings;
}

std::unique_ptr<sensor::Camera> camera_of(ViewList::Kind kind, const ViewedArea& area, const CameraSite& site,
                                          const std::vector<ViewedDirection>& directions) {
  auto list = std::make_shared<ViewList>();
  list->kind = kind;
  list->columns = {{"view_zenith_deg", "degree"}, {"view_azimuth_deg", "degree"}};
  std::vector<std::unique_ptr<const sensor::SingleView>> views;
  sensor::AreaView::Settings settings = area_of(area, site);
  for (const ViewedDirection& direction : directions) {
    list->values.push_back(direction.zenith_rad / math::kDegree);
    list->values.push_back(direction.azimuth_rad / math::kDegree);
    settings.zenith_rad = std::abs(direction.zenith_rad);
    settings.azimuth_rad = direction.azimuth_rad + (direction.zenith_rad < 0.0 ? std::numbers::pi : 0.0);
    views.push_back(std::make_unique<sensor::AreaView>(settings));
  }
  return std::make_unique<sensor::ViewListCamera>(std::move(list), std::move(views));
}

std::vector<ViewedDirection> read_directions(const std::string& path) {
  const ViewColumn columns[] = {{"view_zenith_deg", math::kDegree, -kMostZenith_deg, kMostZenith_deg},
                                {"view_azimuth_deg", math::kDegree, -360.0, 360.0}};
  const std::vector<double> rows = read_view_table(path, columns);
  std::vector<ViewedDirection> directions;
  for (std::size_t k = 0; k < rows.size(); k += 2) directions.push_back({rows[k], rows[k + 1]});
  return directions;
}

}  // namespace

std::unique_ptr<sensor::Camera> DistantSensor::build(const CameraSite& site) const {
  return camera_of(ViewList::Kind::directions, area, site, file ? read_directions(file->path) : directions);
}

std::string DistantSensor::what() const {
  return file ? format("what leaves an area towards the directions of '{}'", file->path)
              : format("what leaves an area towards {} directions", directions.size());
}

std::unique_ptr<sensor::Camera> HemisphereSensor::build(const CameraSite& site) const {
  std::vector<ViewedDirection> chosen;
  for (int cell = 0; cell < cells * cells; ++cell)
    for (int which = 0; which < 2; ++which) {
      const std::uint64_t key = sampling::hash(site.seed, kDirections, cell, which);
      // Nothing is nearer to the horizon than a hundred-thousandth of the hemisphere.
      const math::Vec3 d = sampling::cosine_hemisphere(
          {(cell % cells + sampling::unit_double(sampling::extend(key, 0))) / cells,
           (cell / cells + sampling::unit_double(sampling::extend(key, 1))) / cells});
      chosen.push_back({std::min(std::acos(d.z), kMostZenith_deg * math::kDegree), std::atan2(d.x, d.y)});
    }
  return camera_of(ViewList::Kind::hemisphere, area, site, chosen);
}

std::string HemisphereSensor::what() const {
  return format("what leaves an area towards {} directions over the hemisphere", 2 * cells * cells);
}

}  // namespace ifov::io
