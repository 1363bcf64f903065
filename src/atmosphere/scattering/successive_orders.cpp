#include "atmosphere/scattering/successive_orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "atmosphere/beam_integral.h"
#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/many_orders.h"
#include "atmosphere/scattering/phase/spherical_functions.h"
#include "atmosphere/scattering/shell_means.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {

SuccessiveOrders::SuccessiveOrders(const ScatteringColumn& column, const ColumnPhase& phase,
                                   const GaussNodes& nodes, const ScatteringOptions& options)
    : column_(column), phase_(phase), nodes_(nodes), options_(options), steps_(column, nodes) {}

SuccessiveOrders::Mode SuccessiveOrders::sunlit(int mode, double reference) const {
  const ModeOperator step(column_, phase_, nodes_, steps_, mode, options_.polarized);
  const std::size_t n = column_.sublayers();
  // Moments of the sunbeam itself, at full strength everywhere: its weakening is in the exact integrals.
  const SphericalFunctions beam = spherical_functions(mode, phase_.terms, -column_.sun_mu);
  ModeMoments moments = step.empty_moments();
  const double strength = (mode == 0 ? 1.0 : 2.0) / (2.0 * std::numbers::pi);
  for (int l = mode; l < moments.terms; ++l) {
    std::fill_n(moments.at(l, 0), moments.levels, strength * beam.p[l - mode]);
  }
  const std::vector<double> scattered = step.scatter(moments, 0);
  ModeField field = step.empty_field();
  std::vector<double> up(step.components() * n), down(up);
  for (std::size_t j = 0; j < step.nodes(); ++j) {
    step.expand(j, scattered, up, down);
    for (std::size_t s = 0; s < n; ++s) {
      const double depth = column_.depth[s] / nodes_.position[j];
      const double above = column_.beam_depth[s], below = column_.beam_depth[s + 1];
      const double up_factor = beam_integral(depth, above, below),
                   down_factor = beam_integral(depth, below, above);
      for (int c = 0; c < step.components(); ++c) {
        up[c * n + s] *= up_factor;
        down[c * n + s] *= down_factor;
      }
    }
    step.sweep(j, up, down, field);
  }
  return add_orders(step, std::move(field), step.empty_moments(), reference);
}

SuccessiveOrders::Mode SuccessiveOrders::groundlit() const {
  // Light of the ground changes fast with angle near the horizon, and needs more nodes than what it becomes.
  const GaussNodes fine = gauss_nodes(48);
  return groundlit(0, fine, std::vector<double>(fine.position.size(), 1.0), 0.0);
}

SuccessiveOrders::Mode SuccessiveOrders::groundlit(int mode, const GaussNodes& out,
                                                   std::span<const double> light, double reference) const {
  const ModeOperator step(column_, phase_, nodes_, steps_, mode, options_.polarized);
  const std::size_t levels = column_.sublayers() + 1, outs = out.position.size(), given = light.size() / outs;
  ModeMoments moments = step.empty_moments();
  const std::vector<double>& z_km = column_.altitude_km;
  const double ground_km = column_.ground_km();
  const bool polarized = given > 1 && moments.components > 1;
  const SphericalSeries series(mode, moments.terms, polarized);
  SphericalFunctions f;
  for (std::size_t j = 0; j < outs; ++j) {
    const double mu = out.position[j];
    const double i = light[j], q = given > 1 ? light[outs + j] : 0.0,
                 u = given > 2 ? light[2 * outs + j] : 0.0;
    double depth = 0.0, length = 0.0;
    for (std::size_t level = levels; level-- > 0;) {
      // About a round Earth light of a place arrives the steeper the higher, and the ground ends below the horizontal.
      double arrives = mu, spread = 1.0;
      if (column_.spherical) {
        const double nearer = (kEarthRadius_km + ground_km) / (kEarthRadius_km + z_km[level]);
        arrives = std::sqrt(1.0 - (1.0 - mu * mu) * nearer * nearer);
        spread = mu / arrives * nearer * nearer;
      }
      const double weight = out.weight[j] * spread * std::exp(-depth);
      if (column_.spherical || level + 1 == levels) series.at(arrives, f);
      for (int l = mode; l < moments.terms; ++l) {
        const int at = l - mode;
        moments.at(l, 0)[level] += weight * i * f.p[at];
        if (!polarized) continue;
        moments.at(l, 1)[level] += weight * (f.r[at] * q + (moments.components > 2 ? f.t[at] * u : 0.0));
        if (moments.components > 2) moments.at(l, 2)[level] += weight * (f.t[at] * q + f.r[at] * u);
      }
      if (level == 0) continue;
      double slant = 1.0 / mu;
      if (column_.spherical) {
        const double next = length_to_shell_km(ground_km, mu, z_km[level - 1]);
        slant = (next - length) / (z_km[level - 1] - z_km[level]);
        length = next;
      }
      depth += column_.depth[level - 1] * slant;
    }
  }
  ModeField field = step.next(moments);
  const ModeMoments straight = moments;
  Mode result = add_orders(step, std::move(field), std::move(moments), reference);
  // What the air has scattered comes from within its horizon, but goes on for ever in flat layers.
  if (mode == 0 && column_.spherical && options_.most_orders > 1) {
    const std::vector<double> ratio =
        ShellMeans(column_).ratio_of_scattered({straight.at(0, 0), straight.levels});
    for (std::size_t at = 0; at < straight.values.size(); ++at) {
      double& value = result.moments.values[at];
      value = straight.values[at] + ratio[at % straight.levels] * (value - straight.values[at]);
    }
  }
  return result;
}

SuccessiveOrders::Mode SuccessiveOrders::emitted(std::span<const double> planck) const {
  const ModeOperator step(column_, phase_, nodes_, steps_, 0, options_.polarized);
  const std::size_t n = column_.sublayers();
  std::vector<double> emissivity(n);  // of the source function: 1 - albedo
  for (std::size_t s = 0; s < n; ++s) {
    const ScatteringColumn::Mixture& mixture = column_.mixtures[column_.mixture_of[s]];
    emissivity[s] = std::max(0.0, 1.0 - mixture.rayleigh - mixture.aerosol * (1.0 - mixture.peak));
  }
  // Thin air is bright towards the horizon alone, as the ground is dim there.
  const GaussNodes fine = gauss_nodes(24);
  ModeMoments moments = step.empty_moments();
  std::vector<double> up(n + 1), down(n + 1);
  for (std::size_t j = 0; j < fine.position.size(); ++j) {
    const SphericalFunctions f = spherical_functions(0, phase_.terms, fine.position[j]);
    std::vector<LinearSource> steps(n);
    for (std::size_t s = 0; s < n; ++s) {
      steps[s] = LinearSource::over(column_.depth[s] / fine.position[j]);
      down[s + 1] = steps[s].transmission * down[s] +
                    emissivity[s] * (steps[s].far * planck[s] + steps[s].near * planck[s + 1]);
    }
    for (std::size_t s = n; s-- > 0;)
      up[s] = steps[s].transmission * up[s + 1] +
              emissivity[s] * (steps[s].near * planck[s] + steps[s].far * planck[s + 1]);
    for (int l = 0; l < moments.terms; ++l) {
      const double weight = fine.weight[j] * f.p[l];
      add_scaled(n + 1, weight, up.data(), moments.at(l, 0));
      add_scaled(n + 1, l % 2 == 0 ? weight : -weight, down.data(), moments.at(l, 0));
    }
  }
  ModeField field = step.next(moments);
  return add_orders(step, std::move(field), std::move(moments), 0.0);
}

/// Whether light is scattered so often that orders are not added one by one.
bool SuccessiveOrders::is_thick() const {
  constexpr double kThick = 4.0;  // scaled depth of scattering
  double depth = 0.0;
  for (std::size_t s = 0; s < column_.sublayers(); ++s) {
    const ScatteringColumn::Mixture& mixture = column_.mixtures[column_.mixture_of[s]];
    depth += column_.depth[s] * (mixture.rayleigh + mixture.aerosol * (1.0 - mixture.peak));
  }
  return depth > kThick;
}

void SuccessiveOrders::Mode::take(const ModeOperator& step, ModeField field) {
  for (int c = 0; c < step.components(); ++c)
    for (std::size_t j = 0; j < step.nodes(); ++j)
      ground_down.push_back(field.down_at(c, j)[field.levels - 1]);
  if (step.mode() != 0) return;
  field.up.resize(field.stride);
  field.down.resize(field.stride);
  radiance = {std::move(field.up), std::move(field.down)};
}

/// `sum` holds light that has not been scattered, where that is a source of its own, and `field` what becomes of it.
SuccessiveOrders::Mode SuccessiveOrders::all_at_once(const ModeOperator& step, const ModeField& field,
                                                     const ModeMoments& sum) const {
  Mode result;
  const bool has_source = sum.peak() > 0.0;
  AllOrders all = all_orders(step, has_source ? sum : step.moments_of(field), options_.tolerance);
  ModeField light = step.next(all.moments);
  if (!has_source) {
    add_scaled(light.up.size(), 1.0, field.up.data(), light.up.data());
    add_scaled(light.down.size(), 1.0, field.down.data(), light.down.data());
  }
  result.take(step, std::move(light));
  result.orders = all.scatterings;
  result.moments = std::move(all.moments);
  return result;
}

SuccessiveOrders::Mode SuccessiveOrders::add_orders(const ModeOperator& step, ModeField field,
                                                    ModeMoments sum, double reference) const {
  if (is_thick() && options_.most_orders > 1) return all_at_once(step, field, sum);
  Mode result;
  const ModeField first = field;
  const ModeMoments source = sum;
  ModeField total = step.empty_field();
  double previous = 0.0;
  for (int order = 1;; ++order) {
    const ModeMoments moments = step.moments_of(field);
    const double peak = moments.peak();
    constexpr int kFirst = 4;
    if (order > kFirst && peak > previous && options_.most_orders > kFirst)
      return all_at_once(step, first, source);
    const bool last =
        order == options_.most_orders ||
        peak <= options_.tolerance * std::max({reference, sum.peak(), peak * options_.tolerance});
    // The orders become geometric: the last one stands for all that follow.
    const double ratio = previous > 0.0 ? std::min(peak / previous, 0.99) : 0.0;
    const double factor = last ? 1.0 / (1.0 - ratio) : 1.0;
    // Moments of light scattered once are the source of a second order, which is then not wanted.
    if (options_.most_orders > 1)
      add_scaled(sum.values.size(), factor, moments.values.data(), sum.values.data());
    add_scaled(total.up.size(), factor, field.up.data(), total.up.data());
    add_scaled(total.down.size(), factor, field.down.data(), total.down.data());
    result.orders = order;
    if (last) break;
    previous = peak;
    field = step.next(moments);
  }
  result.take(step, std::move(total));
  result.moments = std::move(sum);
  return result;
}

}  // namespace ifov::atmosphere
