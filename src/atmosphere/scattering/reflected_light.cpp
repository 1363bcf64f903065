#include "atmosphere/scattering/reflected_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/round_earth_light.h"
#include "atmosphere/scattering/successive_orders.h"

namespace ifov::atmosphere {
namespace {

using std::numbers::pi;

constexpr int kMostReturns = 40;  // of light to the ground

double peak_of(const GroundLight& light) {
  double peak = 0.0;
  for (const double value : light) peak = std::max(peak, std::abs(value));
  return peak;
}

void add_to(std::vector<double>& sum, double factor, const std::vector<double>& part) {
  if (sum.empty()) sum.assign(part.size(), 0.0);
  add_scaled(part.size(), factor, part.data(), sum.data());
}

/// One azimuthal mode of the ground's light and of what the air makes of it.
struct ReflectedMode {
  GroundLight now;  // what leaves the ground next; empty: next to nothing
  GroundLight light;
  ModeMoments moments;
};

}  // namespace

FluxProfile diffuse_fluxes(const ScatteringColumn& column, const GaussNodes& nodes,
                           const NodeRadiance& radiance) {
  const std::size_t levels = column.altitude_km.size();
  FluxProfile fluxes{column.altitude_km, std::vector<double>(levels), std::vector<double>(levels),
                     std::vector<double>(levels)};
  for (std::size_t j = 0; j < nodes.position.size(); ++j) {
    const double weight = 2.0 * pi * nodes.weight[j] * nodes.position[j];
    for (std::size_t level = 0; level < levels; ++level) {
      fluxes.up[level] += weight * radiance.up[j * levels + level];
      fluxes.diffuse_down[level] += weight * radiance.down[j * levels + level];
    }
  }
  return fluxes;
}

void send_back(FluxProfile& fluxes, double share) {
  const double all = fluxes.diffuse_down.empty() ? 0.0 : fluxes.diffuse_down.back();
  for (std::size_t level = 0; level < fluxes.up.size(); ++level) {
    fluxes.up[level] += (1.0 - share) * (all - fluxes.diffuse_down[level]);
    fluxes.diffuse_down[level] *= share;
  }
}

std::optional<ReflectedLight> reflected_light(const std::shared_ptr<const SolvedColumn>& solved,
                                              const SuccessiveOrders& orders, const GaussNodes& nodes,
                                              const GroundModes& ground, std::span<const GroundLight> down,
                                              double back, double tolerance) {
  const ScatteringColumn& column = solved->column;
  const double beam = column.sun_mu > 0.0 ? std::exp(-column.beam_depth.back()) : 0.0;
  const double sky = solved->round_earth ? solved->round_earth->flux_ratio().back() : 1.0;
  // What the air scatters has no more modes than its phase functions have terms; what leaves the ground has.
  const int scattered = std::min(ground.modes(), solved->phase.terms);
  std::vector<ReflectedMode> modes(static_cast<std::size_t>(ground.modes()));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const int mode = static_cast<int>(m);
    add_to(modes[m].now, beam, ground.of_beam(mode));
    if (m < down.size()) add_to(modes[m].now, sky, ground.of_diffuse(mode, down[m]));
  }
  const double first = ground.exitance(modes[0].now);
  if (!(first > 0.0)) return std::nullopt;
  const std::size_t levels = column.altitude_km.size();
  FluxProfile fluxes{column.altitude_km, std::vector<double>(levels), std::vector<double>(levels),
                     std::vector<double>(levels)};
  double reference = 0.0, before = 0.0, now = first;
  int most_orders = 0;
  for (int k = 0; k < kMostReturns && now > 0.0; ++k) {
    const double ratio = k > 0 ? std::min(now / before, 0.99) : 0.0;
    const bool last = k > 0 && now * ratio <= tolerance * first;
    const double factor = last ? 1.0 / (1.0 - ratio) : 1.0;
    for (std::size_t m = 0; m < modes.size(); ++m) {
      ReflectedMode& of = modes[m];
      if (!(pi * peak_of(of.now) > tolerance * first)) {
        of.now.clear();
        continue;
      }
      const int mode = static_cast<int>(m);
      if (mode >= scattered) {
        of.light = std::move(of.now);
        of.now.clear();
        continue;
      }
      SuccessiveOrders::Mode found = orders.groundlit(mode, ground.out(), of.now, reference);
      if (m == 0) {
        if (k == 0) reference = found.moments.peak();
        most_orders = std::max(most_orders, found.orders);
        FluxProfile part = diffuse_fluxes(column, nodes, found.radiance);
        send_back(part, back);
        add_to(fluxes.diffuse_down, factor, part.diffuse_down);
        add_to(fluxes.up, factor, part.up);
      }
      add_to(of.light, factor, of.now);
      std::vector<double> values = std::move(of.moments.values);
      add_to(values, factor, found.moments.values);
      of.moments = std::move(found.moments);
      of.moments.values = std::move(values);
      of.now.clear();
      add_to(of.now, back, ground.of_diffuse(mode, found.ground_down));
    }
    if (last || modes[0].now.empty()) break;
    before = now;
    now = ground.exitance(modes[0].now);
  }
  const double exitance = ground.exitance(modes[0].light), scale = pi / exitance;
  ReflectedLight result{
      ScatteredField(nullptr, {}, {}, false, 0), {ground.out(), ground.components(), {}}, exitance};
  std::vector<ModeMoments> moments;
  const std::size_t values_of_mode = modes[0].light.size();
  std::size_t count = modes.size();
  while (modes[count - 1].light.empty()) --count;
  for (std::size_t m = 0; m < count; ++m) {
    ReflectedMode& of = modes[m];
    for (double& value : of.light) value *= scale;
    for (double& value : of.moments.values) value *= scale;
    // A mode of nothing between others has no place among moments, and an empty one in the shape.
    of.light.resize(values_of_mode, 0.0);
    result.shape.modes.push_back(std::move(of.light));
    if (!of.moments.values.empty()) moments.push_back(std::move(of.moments));
  }
  for (std::vector<double>* flux : {&fluxes.up, &fluxes.diffuse_down})
    for (double& value : *flux) value *= scale;
  result.field = ScatteredField(solved, std::move(moments), std::move(fluxes), false, most_orders);
  return result;
}

}  // namespace ifov::atmosphere
