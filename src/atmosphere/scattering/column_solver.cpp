#include "atmosphere/scattering/column_solver.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "atmosphere/scattering/ground/ground_modes.h"
#include "atmosphere/scattering/reflected_light.h"
#include "atmosphere/scattering/round_earth_light.h"
#include "atmosphere/scattering/successive_orders.h"
#include "atmosphere/spherical_shells.h"

namespace ifov::atmosphere {

namespace {

const ScatteringOptions& checked(const ScatteringOptions& options) {
  if (options.nodes_per_hemisphere < 2 || options.nodes_per_hemisphere > 24) {
    throw std::invalid_argument("the scattering solver takes 2 to 24 nodes per hemisphere");
  }
  if (!(options.sublayer_depth > 0.0) || options.most_sublayers < 1 || !(options.tolerance > 0.0) ||
      options.most_orders < 1) {
    throw std::invalid_argument("sublayers, tolerance and orders of the scattering solver must be positive");
  }
  return options;
}

/// Light in the forward peak travels with the beam, but is not the beam. From below the horizon nothing falls on level ground.
void add_beam(const ScatteringColumn& column, FluxProfile& fluxes) {
  if (column.sun_mu < 0.0) return;
  for (std::size_t level = 0; level < fluxes.altitude_km.size(); ++level) {
    const double whole = std::exp(-column.true_beam_depth[level]);
    fluxes.direct_down[level] = column.sun_mu * whole;
    fluxes.diffuse_down[level] += column.sun_mu * (std::exp(-column.beam_depth[level]) - whole);
  }
}

/// Where the Sun is lower than this cosine of the zenith angle, 2 degrees above the horizon, and below the horizon whole, the
/// flux down is that of the sky's radiances: flat layers know nothing of light that comes from beyond the horizon.
constexpr double kLowSun = 0.035;
double flux_of_sky(const ScatteredField& field, double altitude_km, int azimuths) {
  const GaussNodes zeniths = gauss_nodes(12);
  double flux = 0.0;
  for (std::size_t j = 0; j < zeniths.position.size(); ++j) {
    const SlantSource ring = field.along(-zeniths.position[j]);
    double sum = 0.0;
    for (int a = 0; a < azimuths; ++a)
      sum += ring.sky((a + 0.5) * std::numbers::pi / azimuths, altitude_km).radiance().i;
    flux += 2.0 * std::numbers::pi * zeniths.weight[j] * zeniths.position[j] * sum / azimuths;
  }
  return flux;
}
void take_flux_of_sky(const ScatteredField& field, FluxProfile& fluxes) {
  constexpr int kAzimuths = 12;
  const double flux = flux_of_sky(field, fluxes.altitude_km.back(), kAzimuths);
  const double share = std::min(1.0, 1.0 - field.solved().column.sun_mu / kLowSun);
  const double given = fluxes.diffuse_down.back();
  if (!(given > 0.0)) return;
  const double factor = 1.0 + share * (flux / given - 1.0);
  for (double& down : fluxes.diffuse_down) down *= factor;
}

/// Modes of sunlight from the first that is not there yet on.
void add_modes(const SuccessiveOrders& orders, int terms, double reference, double tolerance,
               std::vector<ModeMoments>& modes, std::vector<GroundLight>* down) {
  for (int m = static_cast<int>(modes.size()); m < terms; ++m) {
    SuccessiveOrders::Mode mode = orders.sunlit(m, reference);
    const double peak = mode.moments.peak();
    modes.push_back(std::move(mode.moments));
    if (down != nullptr) down->push_back(std::move(mode.ground_down));
    if (m >= 2 && peak < tolerance * reference) break;
  }
}

}  // namespace

ColumnSolver::ColumnSolver(const ScatteringOptions& options)
    : options_(checked(options)),
      nodes_(gauss_nodes(options.nodes_per_hemisphere)),
      aerosol_(2 * options.nodes_per_hemisphere, options.aerosol_polarization) {}

ColumnSolution ColumnSolver::solve(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                   const GroundModes* ground) const {
  return solve(levels, optics, sun_zenith_rad, options_, ground);
}

GroundModes ColumnSolver::modes_of(const DirectionalGround& ground, double wavelength_um,
                                   double sun_zenith_rad) const {
  return {ground,
          wavelength_um,
          nodes_,
          std::cos(sun_zenith_rad),
          2 * options_.nodes_per_hemisphere,
          options_.polarized};
}

ColumnSolution ColumnSolver::solve_first_order(const Levels& levels, const LayerOptics& optics,
                                               double sun_zenith_rad) const {
  ScatteringOptions once = options_;
  once.most_orders = 1;
  once.polarized = false;
  return solve(levels, optics, sun_zenith_rad, once, nullptr);
}

ColumnSolution ColumnSolver::solve(const Levels& levels, const LayerOptics& optics, double sun_zenith_rad,
                                   const ScatteringOptions& options, const GroundModes* directional) const {
  ScatteringColumn column(levels, optics, sun_zenith_rad, options);
  ColumnPhase phase(column, aerosol_, 2 * options.nodes_per_hemisphere);
  std::shared_ptr<const RoundEarthLight> round_earth;
  if (options.spherical_earth && options.most_orders > 1)
    round_earth = std::make_shared<const RoundEarthLight>(column);
  std::vector<std::vector<ModeMoments>> brighter;
  for (const double sun_rad : round_earth ? round_earth->brighter_suns_rad() : std::vector<double>{}) {
    // Cut into the same sublayers: under Suns so low they are cut alike.
    const ScatteringColumn there(levels, optics, sun_rad, options);
    const SuccessiveOrders of_there(there, phase, nodes_, options);
    SuccessiveOrders::Mode first = of_there.sunlit(0, 0.0);
    const double peak = first.moments.peak();
    brighter.emplace_back().push_back(std::move(first.moments));
    add_modes(of_there, phase.terms, peak, options.tolerance, brighter.back(), nullptr);
  }
  const auto solved = std::make_shared<const SolvedColumn>(SolvedColumn{
      std::move(column), std::move(phase), options_.polarized ? options_.aerosol_polarization : 0.0,
      std::move(round_earth), std::move(brighter)});
  const SuccessiveOrders orders(solved->column, solved->phase, nodes_, options);

  SuccessiveOrders::Mode mode = orders.sunlit(0, 0.0);
  const double reference = mode.moments.peak();
  const int sunlit_orders = mode.orders;
  FluxProfile sunlit_fluxes = diffuse_fluxes(solved->column, nodes_, mode.radiance);
  if (solved->round_earth)
    for (std::size_t level = 0; level < sunlit_fluxes.altitude_km.size(); ++level)
      sunlit_fluxes.diffuse_down[level] *= solved->round_earth->flux_ratio()[level];
  add_beam(solved->column, sunlit_fluxes);
  std::vector<ModeMoments> modes;
  std::vector<GroundLight> down{std::move(mode.ground_down)};
  // Moments of light scattered once are the source of the second order, which was not asked for.
  if (options.most_orders > 1) {
    modes.push_back(std::move(mode.moments));
    add_modes(orders, solved->phase.terms, reference, options.tolerance, modes, &down);
  }

  SuccessiveOrders::Mode ground = orders.groundlit();
  FluxProfile groundlit_fluxes = diffuse_fluxes(solved->column, nodes_, ground.radiance);
  std::vector<ModeMoments> ground_modes;
  ground_modes.push_back(std::move(ground.moments));
  // Of ground's light, too, less comes back about a round Earth: towards the horizon there is less air than in flat layers.
  double back = 1.0;
  if (options.spherical_earth && groundlit_fluxes.diffuse_down.back() > 0.0) {
    const ScatteredField field(solved, ground_modes, groundlit_fluxes, false, ground.orders);
    back = flux_of_sky(field, groundlit_fluxes.altitude_km.back(), 1) / groundlit_fluxes.diffuse_down.back();
    send_back(groundlit_fluxes, back);
  }
  if (solved->round_earth && solved->column.sun_mu < kLowSun)
    take_flux_of_sky(ScatteredField(solved, modes, sunlit_fluxes, true, sunlit_orders), sunlit_fluxes);
  std::shared_ptr<const ReflectedLight> reflected;
  if (directional != nullptr) {
    if (auto found = reflected_light(solved, orders, nodes_, *directional, down, back, options.tolerance))
      reflected = std::make_shared<const ReflectedLight>(*std::move(found));
  }
  return ColumnSolution(
      ScatteredField(solved, std::move(modes), std::move(sunlit_fluxes), true, sunlit_orders),
      ScatteredField(solved, std::move(ground_modes), std::move(groundlit_fluxes), false, ground.orders),
      std::move(reflected));
}

double ColumnSolution::spherical_albedo() const {
  return groundlit_.fluxes().diffuse_down.back() / std::numbers::pi;
}

StokesVector ColumnSolution::diffuse_transmittance(double mu, double observer_km, double surface_km) const {
  const PathLight light = groundlit_.line_of_sight({mu, 0.0}, observer_km, surface_km);
  StokesVector scattered = light.multiple;
  scattered.i += light.peak_transmittance - light.transmittance;
  return scattered;
}

double ColumnSolution::reflected_albedo() const {
  return reflected_->field.fluxes().diffuse_down.back() / std::numbers::pi;
}

StokesVector ColumnSolution::reflected_transmittance(const Propagation& direction, double observer_km,
                                                     double surface_km) const {
  const PathLight light = reflected_->field.line_of_sight(direction, observer_km, surface_km);
  return light.multiple + (light.peak_transmittance - light.transmittance) *
                              reflected_->shape.radiance(direction.mu, direction.azimuth_rad);
}

/// Depths from the ground up to an altitude along lines that leave the ground under these cosines, scaled: what goes on in the
/// forward peak has not been scattered.
std::vector<double> ColumnSolution::depths_below(double altitude_km, const std::vector<double>& mu) const {
  const ScatteringColumn& column = groundlit_.solved().column;
  const double ground_km = column.ground_km();
  std::vector<double> depths;
  for (const double cosine : mu) {
    double depth = 0.0, length = 0.0;
    for (std::size_t s = column.sublayers(); s-- > 0 && column.altitude_km[s + 1] < altitude_km;) {
      const double high = std::min(altitude_km, column.altitude_km[s]);
      const double next =
          column.spherical ? length_to_shell_km(ground_km, cosine, high) : (high - ground_km) / cosine;
      depth += column.depth[s] * (next - length) / (column.altitude_km[s] - column.altitude_km[s + 1]);
      length = next;
    }
    depths.push_back(depth);
  }
  return depths;
}

ColumnSolution::GroundFlux ColumnSolution::ground_flux(double altitude_km) const {
  static const GaussNodes nodes = gauss_nodes(48);
  const std::vector<double> depths = depths_below(altitude_km, nodes.position);
  double straight = 0.0;
  for (std::size_t j = 0; j < depths.size(); ++j)
    straight += 2.0 * nodes.weight[j] * nodes.position[j] * std::exp(-depths[j]);
  const FluxProfile::Fluxes scattered = groundlit_.fluxes().at(altitude_km);
  return {straight + scattered.up / std::numbers::pi, scattered.diffuse_down / std::numbers::pi};
}

ColumnSolution::GroundFlux ColumnSolution::reflected_flux(double altitude_km) const {
  const GaussNodes& out = reflected_->shape.out;
  const std::vector<double> depths = depths_below(altitude_km, out.position);
  double straight = 0.0;
  for (std::size_t j = 0; j < out.position.size(); ++j)
    straight += 2.0 * out.weight[j] * out.position[j] * std::exp(-depths[j]) * reflected_->shape.modes[0][j];
  const FluxProfile::Fluxes scattered = reflected_->field.fluxes().at(altitude_km);
  return {straight + scattered.up / std::numbers::pi, scattered.diffuse_down / std::numbers::pi};
}

double straight_flux(double depth) {
  static const GaussNodes nodes = gauss_nodes(48);
  double sum = 0.0;
  for (std::size_t j = 0; j < nodes.position.size(); ++j)
    sum += 2.0 * nodes.weight[j] * nodes.position[j] * std::exp(-depth / nodes.position[j]);
  return sum;
}

double ColumnSolution::sun_transmittance(double altitude_km) const {
  const ScatteringColumn& column = sunlit_.solved().column;
  const auto& altitude = column.altitude_km;
  const auto below = std::lower_bound(altitude.begin(), altitude.end(), altitude_km, std::greater<>());
  if (below == altitude.begin()) return std::exp(-column.true_beam_depth.front());
  if (below == altitude.end()) return std::exp(-column.true_beam_depth.back());
  const std::size_t at = static_cast<std::size_t>(below - altitude.begin());
  const double share = (altitude[at - 1] - altitude_km) / (altitude[at - 1] - altitude[at]);
  const double depth = column.true_beam_depth[at - 1] * (1.0 - share) + column.true_beam_depth[at] * share;
  return std::exp(-depth);
}

}  // namespace ifov::atmosphere
