#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "materials/bsdf/bsdf.h"
#include "radiometry/spectral_nodes.h"
#include "scene/scene.h"
#include "session/loaded/parts.h"
#include "session/solved/solved_temperatures.h"
#include "transport/spectral_scene.h"

namespace ifov::session {
namespace {

constexpr double kWarm_um = 3.0;  // surfaces emit beyond it

/// By truth material, of what the worst of them may be off by: the material's own, and what it shows of others, which may be the
/// worst. Nothing where pixels hold light of materials that their abundances do not tell.
std::vector<double> shares_of_worst(const Parts& parts) {
  if (!parts.wings.empty() || parts.groups != nullptr || !parts.psf_cut.empty()) return {};
  const TemperatureErrors& errors = *parts.temperature_errors;
  const scene::TruthMaterials truth = scene::truth_materials(parts.scene);
  std::vector<double> shares(truth.names.size(), 0.0);
  for (std::uint32_t m = 0; m < parts.scene.materials.size(); ++m) {
    const auto own = errors.by_material.find(m);
    const double own_share = own != errors.by_material.end() && errors.half_width_k() > 0.0
                                 ? own->second.half_width_k() / errors.half_width_k()
                                 : 0.0;
    const double shown =
        parts.scene.materials[m].bsdf->is_lambertian() ? parts.spectral_scene->brightest(m) : 1.0;
    double& share = shares[truth.of_material[m]];
    share = std::max(share, std::min(1.0, own_share + shown));
  }
  return shares;
}

/// What an accuracy in kelvins can be had of, by materials that are solved, each with what it shows of others.
struct Reach {
  double least_k = 0.0,
         kept_k =
             0.0;  ///< of what the camera sees the most certain; the least certain of those that can be kept
  std::string most_certain, beyond;  ///< names; of those beyond with what they may be off by
};

Reach reach_of(const Parts& parts, const std::vector<double>& shares, double asked_k) {
  const TemperatureErrors& errors = *parts.temperature_errors;
  const scene::TruthMaterials truth = scene::truth_materials(parts.scene);
  Reach reach;
  for (const auto& [material, error] : errors.by_material) {
    const std::uint32_t number = truth.of_material[material];
    const double off_k = errors.half_width_k() * (shares.empty() ? 1.0 : shares[number]);
    if (off_k <= asked_k)
      reach.kept_k = std::max(reach.kept_k, off_k);
    else
      reach.beyond +=
          format("{}'{}' ({:.2f} K)", reach.beyond.empty() ? "" : ", ", truth.names[number], off_k);
    if (error.seen == 0 || (!reach.most_certain.empty() && off_k >= reach.least_k)) continue;
    reach.least_k = off_k;
    reach.most_certain = truth.names[number];
  }
  return reach;
}

/// Nothing in the image can be had as accurately as that: an error. Some of it: that is told.
void refuse_or_tell(const Parts& parts, const Reach& reach, double asked_k, LogSink& log) {
  const double half_width_k = parts.temperature_errors->half_width_k();
  const double enough_k = std::ceil(20.0 * half_width_k) / 10.0;
  if (reach.least_k > asked_k || reach.most_certain.empty())
    throw InputError(format(
        "an accuracy of {:g} K is asked for, and temperatures that are solved may themselves be off by {:.2f} K{}: "
        "{}. Ask for {:.1f} K or more",
        asked_k, half_width_k,
        reach.least_k > 0.0 && reach.least_k < half_width_k
            ? format(", those of '{}', which is known best of what the camera sees, by {:.2f} K",
                     reach.most_certain, reach.least_k)
            : "",
        parts.temperature_errors->statement(), enough_k));
  if (reach.beyond.empty()) return;  // only of what is seen by way of others, which is kept
  log.warn(format(
      "an accuracy of {:g} K is asked for, and temperatures that are solved may themselves be off by more in {}: pixels of these "
      "will not be converged, and get the rays of those that can be. {:.1f} K or more can be kept in all",
      asked_k, reach.beyond, enough_k));
}

}  // namespace

bool may_show_unseen(const scene::Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const materials::Material& material) { return !material.bsdf->is_lambertian(); });
}

void count_temperature_errors(Parts& parts, LogSink& log) {
  if (!parts.temperature_errors) return;
  const double half_width_k = parts.temperature_errors->half_width_k();
  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  const std::vector<double> shares = shares_of_worst(parts);
  double given_up = 0.0;  // of the half-width
  if (request != nullptr && request->unit == render::ErrorUnit::kelvin && request->error < half_width_k) {
    const Reach reach = reach_of(parts, shares, request->error);
    refuse_or_tell(parts, reach, request->error, log);
    given_up = 1.0 - reach.kept_k / half_width_k;
  }
  const std::size_t channels = parts.nodes->channel_count();
  std::vector<double> cooler(channels), warmer(channels);
  const scene::TemperatureRange range = *parts.scene.mapped_temperatures();
  const double middle_k = 0.5 * (range.coldest_k + range.hottest_k);
  parts.nodes->planck_channels(middle_k - 0.5, cooler);
  parts.nodes->planck_channels(middle_k + 0.5, warmer);
  parts.node_errors.resize(channels);
  bool too_fine = false;
  for (std::size_t c = 0; c < channels; ++c) {
    const double emitted = half_width_k * (warmer[c] - cooler[c]);
    parts.node_errors[c].emitted = emitted;
    parts.node_errors[c].given_up = given_up * emitted;
    parts.node_errors[c].emitted_of = shares;
    for (double& of_material : parts.node_errors[c].emitted_of) of_material *= emitted;
    too_fine = too_fine || (request != nullptr && request->unit == render::ErrorUnit::percent &&
                            parts.channels[c].centre_um > kWarm_um &&
                            emitted > request->error * 0.5 * (cooler[c] + warmer[c]));
  }
  if (too_fine)
    log.warn(format(
        "temperatures that are solved may be off by {:.2f} K, which is more than the {:g} % that are asked for: {}",
        half_width_k, 100.0 * request->error, parts.temperature_errors->statement()));
}

}  // namespace ifov::session
