#include "render/flown_pilots.h"

#include <map>
#include <set>

#include "render/moving/flown_exposure.h"
#include "sensor/camera.h"
#include "sensor/flying/flying_frame_camera.h"

namespace ifov::render {
namespace {

/// Which points stand for an object by itself, by its number.
std::map<std::uint32_t, std::size_t> single_points(const PilotRays::Near& near) {
  std::map<std::uint32_t, std::size_t> points;
  std::set<std::uint32_t> several{sampling::Field::kNoObject};
  for (std::size_t k = 0; k < near.objects.size(); ++k)
    if (!points.emplace(near.objects[k], k).second) several.insert(near.objects[k]);
  for (const std::uint32_t object : several) points.erase(object);
  return points;
}

}  // namespace

std::unique_ptr<const sensor::Camera> camera_at(const sensor::Camera& camera, double time_s) {
  return camera.flying()->at_instant(time_s);
}

PilotRays::Near FlownPilots::near(sampling::PixelRect tile, double margin_px, FlownExposure& exposure) const {
  std::vector<PilotRays::Near> found;
  std::vector<std::map<std::uint32_t, std::size_t>> single;
  for (const PilotRays& rays : by_instant_) {
    found.push_back(rays.near(tile, margin_px));
    single.push_back(single_points(found.back()));
  }
  PilotRays::Near all;
  std::vector<FlownExposure::Dot> dots;
  const std::size_t last = found.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    for (std::size_t j = 0; j < found[k].points.size(); ++j) {
      all.points.push_back(found[k].points[j]);
      // Where it is smeared it is no object of its own.
      all.objects.push_back(sampling::Field::kNoObject);
      FlownExposure::Dot dot{found[k].points[j], found[k].radii_px[j], k};
      const std::uint32_t object = found[k].objects[j];
      const bool alone = single[k].contains(object),
                 before = k > 0 && alone && single[k - 1].contains(object),
                 after = k < last && alone && single[k + 1].contains(object);
      if (!(after || (k == last && alone)) || !(before || (k == 0 && alone))) dots.push_back(dot);
      if (!after) continue;
      dot.next = found[k + 1].points[single[k + 1].at(object)];
      dots.push_back(dot);
    }
  exposure.follow(std::move(dots));
  return all;
}

}  // namespace ifov::render
