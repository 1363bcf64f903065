#include <algorithm>
#include <cmath>
#include <numeric>

#include "exposure/exposed_point.h"
#include "exposure/solved_surface.h"

namespace ifov::exposure {
namespace {

constexpr std::size_t kLooks = 24;
constexpr int kSkyLooks = 8;

}  // namespace

SolvedSurface::Unsettled SolvedSurface::unsettled(const geometry::SurfacePoint& point) const {
  const ExposedPoint exposed(scene_, point, two_faces_);
  const thermal::Pose pose = exposed.pose();
  std::vector<double> sums_k(classes_->sunlit_rows());
  const double of_sky_k = classes_->shaded(pose, 1.0, sums_k).of_sky_k;
  std::partial_sum(sums_k.begin(), sums_k.end(), sums_k.begin());
  Unsettled found;
  std::vector<math::Vec3> directions;
  std::vector<double> times_s;
  std::vector<std::uint8_t> was_free(std::max<std::size_t>(kLooks, 2 * kSkyLooks)), is_free = was_free;
  if (const double rise_k = sums_k.empty() ? 0.0 : sums_k.back(); rise_k > 0.0) {
    for (std::size_t k = 0; k < kLooks; ++k) {
      const double place = rise_k * (static_cast<double>(k) + 0.5) / kLooks;
      const auto row = static_cast<std::size_t>(std::upper_bound(sums_k.begin(), sums_k.end() - 1, place) -
                                                sums_k.begin());
      directions.push_back(classes_->sun_at(row, 0.0));
      if (scene_.changes()) times_s.push_back(classes_->time_s(classes_->row_of_series(row), 0.0));
    }
    exposed.free(directions, times_s, was_free);
    const double seen = std::accumulate(was_free.begin(), was_free.begin() + kLooks, 0.0) / kLooks;
    found.mixed_k = rise_k * seen * (1.0 - seen);
    if (scene_.changes()) {
      exposed.free(directions, {}, is_free);
      for (std::size_t k = 0; k < kLooks; ++k)
        if (is_free[k] != was_free[k]) found.changed_k += rise_k / kLooks;
    }
  }
  if (changed_rows_.empty()) return found;
  exposed.sky_directions(0, kSkyLooks, directions);
  if (directions.empty()) return found;
  exposed.free(directions, {}, is_free);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double time_s = classes_->time_s(changed_rows_[changed_rows_.size() * k / directions.size()], 0.0);
    exposed.free({&directions[k], 1}, {&time_s, 1}, {&was_free[k], 1});
    if (is_free[k] != was_free[k])
      found.changed_k += std::abs(of_sky_k) / static_cast<double>(directions.size());
  }
  return found;
}

}  // namespace ifov::exposure
