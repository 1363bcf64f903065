#include "transport/mirrors/round_mirrors.h"

#include "geometry/world.h"
#include "scene/scene.h"

namespace ifov::transport {

using geometry::SurfaceSurvey;

RoundMirrors::RoundMirrors(const scene::Scene& scene, const SurfaceSurvey& survey) {
  for (const scene::SurfaceAssignment& assignment : scene.assignments)
    bends_.push_back(assignment.bends_normals());
  // An object counts whole: a hit does not tell which of its shapes it is on.
  std::vector<std::uint32_t> stretched;
  for (const SurfaceSurvey::Round& round : survey.rounds)
    if (!RoundMirror::of(round)) stretched.push_back(round.object);
  std::sort(stretched.begin(), stretched.end());
  const bool any = !scene.world->period() && survey.rounds.size() <= kMost,
             reliefs = std::find(bends_.begin(), bends_.end(), true) != bends_.end();
  for (const SurfaceSurvey::Round& round : survey.rounds) {
    const bool sought = any && !std::binary_search(stretched.begin(), stretched.end(), round.object);
    if (sought) {
      rounds_.push_back(*RoundMirror::of(round));
      objects_.push_back(round.object);
    }
    if (!sought || reliefs || rounds_.back().hollow()) unsought_.push_back(round.ball);
    if (sought && !reliefs) whole_.push_back(round.object);
  }
  std::sort(objects_.begin(), objects_.end());
  for (const RoundMirror& round : rounds_)
    if (round.hollow()) std::erase(whole_, round.object());
  std::sort(whole_.begin(), whole_.end());
}

double RoundMirrors::shares(math::Point3 from) const {
  double all = 0.0;
  for (const RoundMirror& round : rounds_) all += round.share_of_view(from);
  return all;
}

std::optional<RoundMirrors::Met> RoundMirrors::met(math::Point3 from,
                                                   const geometry::SurfacePoint& hit) const {
  if (!sought(hit)) return {};
  for (std::size_t k = 0; k < rounds_.size(); ++k) {
    if (rounds_[k].object() != hit.instance) continue;
    if (const std::optional<RoundMirror::Image> image = rounds_[k].met(from, hit.position_m))
      return Met{k, *image};
  }
  return {};
}

}  // namespace ifov::transport
