#include <algorithm>
#include <cmath>
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

}  // namespace

namespace {

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

}  // namespace

void count_temperature_errors(Parts& parts, LogSink& log) {
  if (!parts.temperature_errors) return;
  const double half_width_k = parts.temperature_errors->half_width_k();
  const render::AccuracyRequest* request = parts.plan.request ? &*parts.plan.request : nullptr;
  if (request != nullptr && request->unit == render::ErrorUnit::kelvin && request->error < half_width_k)
    throw InputError(format(
        "an accuracy of {:g} K is asked for, and temperatures that are solved may themselves be off by {:.2f} K: "
        "{}. Ask for {:.1f} K or more",
        request->error, half_width_k, parts.temperature_errors->statement(),
        std::ceil(20.0 * half_width_k) / 10.0));
  const std::size_t channels = parts.nodes->channel_count();
  std::vector<double> cooler(channels), warmer(channels);
  const scene::TemperatureRange range = *parts.scene.mapped_temperatures();
  const double middle_k = 0.5 * (range.coldest_k + range.hottest_k);
  parts.nodes->planck_channels(middle_k - 0.5, cooler);
  parts.nodes->planck_channels(middle_k + 0.5, warmer);
  parts.node_errors.resize(channels);
  const std::vector<double> shares = shares_of_worst(parts);
  bool too_fine = false;
  for (std::size_t c = 0; c < channels; ++c) {
    const double emitted = half_width_k * (warmer[c] - cooler[c]);
    parts.node_errors[c].emitted = emitted;
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
