#include "render/mirrors/sought_instants.h"

#include <algorithm>
#include <cmath>

#include "render/mirrors/glint_search.h"
#include "render/moving/flown_exposure.h"
#include "sampling/random.h"
#include "sensor/camera.h"
#include "sensor/flying/flying_frame_camera.h"

namespace ifov::render {
namespace {

/// How far the picture may move from one instant of a replicate to the next; of all together it is an eighth.
constexpr double kStratum_px = 0.5;
constexpr double kFewestStrata = 2.0, kMostStrata = 32.0;
constexpr int kLatticeTimes = 8;
constexpr std::uint64_t kSoughtInstants = 0x696e7374616e74ull;

}  // namespace

SoughtInstants::SoughtInstants(const scene::Scene& scene, const sensor::Camera& camera, std::uint64_t seed)
    : camera_(camera), seed_(seed) {
  const auto flown = FlownExposure::find(scene, camera);
  if (flown == nullptr) return;
  const auto strata =
      static_cast<int>(std::clamp(std::ceil(flown->way_px() / kStratum_px), kFewestStrata, kMostStrata));
  for (int s = 0; s < strata; ++s)
    for (std::uint32_t replicate = 0; replicate < GlintSearch::kReplicates; ++replicate) {
      const double u = sampling::unit_double(sampling::hash(seed, kSoughtInstants, s, replicate));
      times_s_.push_back(camera.exposure_s() * ((s + u) / strata - 0.5));
      cameras_.push_back(camera.flying()->at_instant(times_s_.back()));
    }
}

SoughtInstants::~SoughtInstants() = default;

const sensor::Camera& SoughtInstants::camera(std::size_t k) const {
  return cameras_.empty() ? camera_ : *cameras_[k];
}

std::uint64_t SoughtInstants::seed(std::size_t k) const {
  return cameras_.empty() ? seed_ : sampling::hash(seed_, kSoughtInstants, k);
}

GlintPoint SoughtInstants::point(std::size_t k, GlintPoint found) const {
  if (times_s_.empty()) return found;
  found.image.time_s = times_s_[k];
  found.replicate = static_cast<std::uint32_t>(k) % GlintSearch::kReplicates;
  // All points of an instant are in its replicate, which has as many instants as there are strata.
  found.area /= static_cast<double>(times_s_.size());
  return found;
}

std::vector<double> lattice_times_s(const sensor::Camera& camera) {
  if (!camera.moves_while_exposed()) return {0.0};
  std::vector<double> times_s;
  for (int k = 0; k < kLatticeTimes; ++k)
    times_s.push_back(camera.exposure_s() * ((k + 0.5) / kLatticeTimes - 0.5));
  return times_s;
}

}  // namespace ifov::render
