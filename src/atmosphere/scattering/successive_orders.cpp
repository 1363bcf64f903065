#include "atmosphere/scattering/successive_orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/linear_source.h"
#include "atmosphere/scattering/spherical_functions.h"

namespace ifov::atmosphere {

namespace {

/// (1 - exp(-x)) / x for x >= 0.
double mean_transmission(double x) { return x < 1e-8 ? 1.0 - 0.5 * x : -std::expm1(-x) / x; }

void add(std::size_t n, double factor, const double* __restrict from, double* __restrict to) {
  for (std::size_t i = 0; i < n; ++i) to[i] += factor * from[i];
}

}  // namespace

double beam_integral(double depth, double near_beam, double far_beam) {
  const double x = depth + far_beam - near_beam;
  return x >= 0.0 ? std::exp(-near_beam) * depth * mean_transmission(x)
                  : std::exp(-far_beam - depth) * depth * mean_transmission(-x);
}

double ModeMoments::peak() const {
  double largest = 0.0;
  for (double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

ColumnPhase::ColumnPhase(const ScatteringColumn& column, const AerosolProjection& aerosol, int most_terms)
    : sublayers(column.sublayers()) {
  const bool any_aerosol = std::any_of(column.mixtures.begin(), column.mixtures.end(),
                                       [](const auto& mixture) { return mixture.aerosol > 0.0; });
  terms = any_aerosol ? most_terms : std::min(3, most_terms);
  for (auto* table : {&beta, &alpha, &zeta, &gamma}) table->assign(terms * sublayers, 0.0);
  const PhaseExpansion molecules = rayleigh_expansion(terms, column.depolarization);
  PhaseExpansion particles;
  double asymmetry = 2.0;  // of `particles`; no asymmetry has this value
  for (std::size_t s = 0; s < sublayers; ++s) {
    const ScatteringColumn::Mixture& mixture = column.mixtures[column.mixture_of[s]];
    if (mixture.aerosol > 0.0 && mixture.asymmetry != asymmetry) {
      asymmetry = mixture.asymmetry;
      particles = aerosol.expansion(asymmetry);
    }
    for (int l = 0; l < terms; ++l) {
      const std::size_t at = l * sublayers + s;
      const double r = 0.5 * mixture.rayleigh;
      beta[at] = r * molecules.beta[l];
      alpha[at] = r * molecules.alpha[l];
      gamma[at] = r * molecules.gamma[l];
      if (mixture.aerosol <= 0.0) continue;
      const double a = 0.5 * mixture.aerosol, forward = mixture.peak * (2.0 * l + 1.0);
      beta[at] += a * (particles.beta[l] - forward);
      gamma[at] += a * particles.gamma[l];
      if (l < 2) continue;  // Q and U have no terms below 2
      alpha[at] += a * (particles.alpha[l] - forward);
      zeta[at] += a * (particles.zeta[l] - forward);
    }
  }
}

/// Radiances [component][node][level] of the upward and the downward hemisphere.
struct SuccessiveOrders::Field {
  Field(int components, std::size_t nodes, std::size_t level_count)
      : levels(level_count),
        stride(nodes * level_count),
        up(components * stride, 0.0),
        down(components * stride, 0.0) {}
  std::size_t levels, stride;
  std::vector<double> up, down;
  double* up_at(int component, std::size_t node) { return up.data() + component * stride + node * levels; }
  double* down_at(int component, std::size_t node) {
    return down.data() + component * stride + node * levels;
  }
};

/// The functions of one mode at the nodes, and the sums over directions and over l that use their symmetry:
/// at -mu, p and r have the sign (-1)^(l + mode), t the other one.
struct SuccessiveOrders::Kernel {
  Kernel(const SuccessiveOrders& solver, int mode_number)
      : owner(solver),
        mode(mode_number),
        components(solver.options_.polarized ? (mode_number == 0 ? 2 : 3) : 1) {
    for (double mu : owner.nodes_.position)
      functions.push_back(spherical_functions(mode, owner.phase_.terms, mu));
  }
  const SuccessiveOrders& owner;
  int mode;
  int components;  ///< mode 0 has no U
  std::vector<SphericalFunctions> functions;

  std::size_t nodes() const { return functions.size(); }
  std::size_t sublayers() const { return owner.column_.sublayers(); }

  ModeMoments empty() const {
    ModeMoments moments{mode, owner.phase_.terms, components, sublayers() + 1, {}};
    moments.values.assign(static_cast<std::size_t>(moments.terms - mode) * components * moments.levels, 0.0);
    return moments;
  }

  ModeMoments moments_of(Field& field) const {
    const std::size_t levels = sublayers() + 1;
    ModeMoments moments = empty();
    std::vector<double> sum(components * levels), difference(components * levels);
    for (std::size_t j = 0; j < nodes(); ++j) {
      const double weight = owner.nodes_.weight[j];
      for (int c = 0; c < components; ++c) {
        const double *up = field.up_at(c, j), *down = field.down_at(c, j);
        for (std::size_t i = 0; i < levels; ++i) {
          sum[c * levels + i] = up[i] + down[i];
          difference[c * levels + i] = up[i] - down[i];
        }
      }
      for (int l = mode; l < moments.terms; ++l) {
        const bool even = (l - mode) % 2 == 0;
        const double* same = even ? sum.data() : difference.data();
        const double* other = even ? difference.data() : sum.data();
        const SphericalFunctions& f = functions[j];
        const int at = l - mode;
        add(levels, weight * f.p[at], same, moments.at(l, 0));
        if (components > 1) add(levels, weight * f.r[at], same + levels, moments.at(l, 1));
        if (components > 2) {
          add(levels, weight * f.t[at], other + 2 * levels, moments.at(l, 1));
          add(levels, weight * f.t[at], other + levels, moments.at(l, 2));
          add(levels, weight * f.r[at], same + 2 * levels, moments.at(l, 2));
        }
      }
    }
    return moments;
  }

  /// Phase coefficients times moments: [l - mode][component][sublayer], the moments of sublayer s being those
  /// of boundary s + offset.
  std::vector<double> scatter(const ModeMoments& moments, std::size_t offset) const {
    const std::size_t n = sublayers();
    const ColumnPhase& phase = owner.phase_;
    std::vector<double> result(static_cast<std::size_t>(moments.terms - mode) * components * n);
    for (int l = mode; l < moments.terms; ++l) {
      double* to = result.data() + static_cast<std::size_t>(l - mode) * components * n;
      const double *beta = phase.at(phase.beta, l), *gamma = phase.at(phase.gamma, l);
      const double *alpha = phase.at(phase.alpha, l), *zeta = phase.at(phase.zeta, l);
      const double* i = moments.at(l, 0) + offset;
      if (components == 1) {
        for (std::size_t s = 0; s < n; ++s) to[s] = beta[s] * i[s];
        continue;
      }
      const double* q = moments.at(l, 1) + offset;
      for (std::size_t s = 0; s < n; ++s) {
        to[s] = beta[s] * i[s] + gamma[s] * q[s];
        to[n + s] = gamma[s] * i[s] + alpha[s] * q[s];
      }
      if (components < 3) continue;
      const double* u = moments.at(l, 2) + offset;
      for (std::size_t s = 0; s < n; ++s) to[2 * n + s] = zeta[s] * u[s];
    }
    return result;
  }

  /// Source at node j from scattered moments: [component][sublayer] going up and coming down.
  void expand(std::size_t j, const std::vector<double>& scattered, std::vector<double>& up,
              std::vector<double>& down) const {
    const std::size_t n = sublayers();
    std::fill(up.begin(), up.end(), 0.0);      // first the part that is even in mu,
    std::fill(down.begin(), down.end(), 0.0);  // and here the odd part
    const SphericalFunctions& f = functions[j];
    for (int at = 0; at < static_cast<int>(f.p.size()); ++at) {
      const double* from = scattered.data() + static_cast<std::size_t>(at) * components * n;
      double* same = at % 2 == 0 ? up.data() : down.data();
      double* other = at % 2 == 0 ? down.data() : up.data();
      add(n, f.p[at], from, same);
      if (components > 1) add(n, f.r[at], from + n, same + n);
      if (components > 2) {
        add(n, f.t[at], from + 2 * n, other + n);
        add(n, f.t[at], from + n, other + 2 * n);
        add(n, f.r[at], from + 2 * n, same + 2 * n);
      }
    }
    for (std::size_t i = 0; i < up.size(); ++i) {
      const double even = up[i], odd = down[i];
      up[i] = even + odd;
      down[i] = even - odd;
    }
  }

  /// Field of light scattered once more.
  Field next(const ModeMoments& moments) const {
    const std::size_t n = sublayers();
    const std::vector<double> top = scatter(moments, 0), bottom = scatter(moments, 1);
    Field field(components, nodes(), n + 1);
    std::vector<double> up_top(components * n), down_top(up_top), up_bottom(up_top), down_bottom(up_top);
    for (std::size_t j = 0; j < nodes(); ++j) {
      expand(j, top, up_top, down_top);
      expand(j, bottom, up_bottom, down_bottom);
      const double *near = owner.near_.data() + j * n, *far = owner.far_.data() + j * n;
      for (int c = 0; c < components; ++c) {
        double *a = up_top.data() + c * n, *b = up_bottom.data() + c * n;
        double *d = down_top.data() + c * n, *e = down_bottom.data() + c * n;
        for (std::size_t s = 0; s < n; ++s) {
          a[s] = near[s] * a[s] + far[s] * b[s];
          d[s] = far[s] * d[s] + near[s] * e[s];
        }
      }
      sweep(j, up_top, down_top, field);
    }
    return field;
  }

  /// Carries light through the sublayers, given what each adds.
  void sweep(std::size_t j, const std::vector<double>& up_gain, const std::vector<double>& down_gain,
             Field& field) const {
    const std::size_t n = sublayers();
    const double* t = owner.transmission_.data() + j * n;
    for (int c = 0; c < components; ++c) {
      double *up = field.up_at(c, j), *down = field.down_at(c, j);
      for (std::size_t s = 0; s < n; ++s) {
        down[s + 1] = down[s] * t[s] + down_gain[c * n + s];
        const std::size_t r = n - 1 - s;
        up[r] = up[r + 1] * t[r] + up_gain[c * n + r];
      }
    }
  }
};

SuccessiveOrders::SuccessiveOrders(const ScatteringColumn& column, const ColumnPhase& phase,
                                   const GaussNodes& nodes, const ScatteringOptions& options)
    : column_(column), phase_(phase), nodes_(nodes), options_(options) {
  for (double mu : nodes.position) {
    for (double depth : column.depth) {
      const LinearSource step = LinearSource::over(depth / mu);
      transmission_.push_back(step.transmission);
      near_.push_back(step.near);
      far_.push_back(step.far);
    }
  }
}

SuccessiveOrders::Mode SuccessiveOrders::sunlit(int mode, double reference) const {
  const Kernel kernel(*this, mode);
  const std::size_t n = column_.sublayers();
  // Moments of the sunbeam itself, at full strength everywhere: its weakening is in the exact integrals.
  const SphericalFunctions beam = spherical_functions(mode, phase_.terms, -column_.sun_mu);
  ModeMoments moments = kernel.empty();
  const double strength = (mode == 0 ? 1.0 : 2.0) / (2.0 * std::numbers::pi);
  for (int l = mode; l < moments.terms; ++l) {
    std::fill_n(moments.at(l, 0), moments.levels, strength * beam.p[l - mode]);
  }
  const std::vector<double> scattered = kernel.scatter(moments, 0);
  Field field(kernel.components, kernel.nodes(), n + 1);
  std::vector<double> up(kernel.components * n), down(up);
  for (std::size_t j = 0; j < kernel.nodes(); ++j) {
    kernel.expand(j, scattered, up, down);
    for (std::size_t s = 0; s < n; ++s) {
      const double depth = column_.depth[s] / nodes_.position[j];
      const double above = column_.beam_depth[s], below = column_.beam_depth[s + 1];
      const double up_factor = beam_integral(depth, above, below),
                   down_factor = beam_integral(depth, below, above);
      for (int c = 0; c < kernel.components; ++c) {
        up[c * n + s] *= up_factor;
        down[c * n + s] *= down_factor;
      }
    }
    kernel.sweep(j, up, down, field);
  }
  return add_orders(kernel, std::move(field), kernel.empty(), reference);
}

SuccessiveOrders::Mode SuccessiveOrders::groundlit() const {
  const Kernel kernel(*this, 0);
  const std::size_t levels = column_.sublayers() + 1;
  // Light of the ground changes fast with angle near the horizon, and needs more nodes than what it becomes.
  const GaussNodes fine = gauss_nodes(48);
  ModeMoments moments = kernel.empty();
  for (std::size_t j = 0; j < fine.position.size(); ++j) {
    const SphericalFunctions f = spherical_functions(0, phase_.terms, fine.position[j]);
    double depth = 0.0;
    for (std::size_t level = levels; level-- > 0;) {
      const double light = fine.weight[j] * std::exp(-depth / fine.position[j]);
      for (int l = 0; l < moments.terms; ++l) moments.at(l, 0)[level] += light * f.p[l];
      if (level > 0) depth += column_.depth[level - 1];
    }
  }
  Field field = kernel.next(moments);
  return add_orders(kernel, std::move(field), std::move(moments), 0.0);
}

SuccessiveOrders::Mode SuccessiveOrders::add_orders(const Kernel& kernel, Field field, ModeMoments sum,
                                                    double reference) const {
  Mode result;
  Field total(kernel.components, kernel.nodes(), column_.sublayers() + 1);
  double previous = 0.0;
  for (int order = 1;; ++order) {
    const ModeMoments moments = kernel.moments_of(field);
    const double peak = moments.peak();
    const bool last =
        order == options_.most_orders ||
        peak <= options_.tolerance * std::max({reference, sum.peak(), peak * options_.tolerance});
    // The orders become geometric: the last one stands for all that follow.
    const double ratio = previous > 0.0 ? std::min(peak / previous, 0.99) : 0.0;
    const double factor = last ? 1.0 / (1.0 - ratio) : 1.0;
    // Moments of light scattered once are the source of a second order, which is then not wanted.
    if (options_.most_orders > 1) add(sum.values.size(), factor, moments.values.data(), sum.values.data());
    add(total.up.size(), factor, field.up.data(), total.up.data());
    add(total.down.size(), factor, field.down.data(), total.down.data());
    result.orders = order;
    if (last) break;
    previous = peak;
    field = kernel.next(moments);
  }
  if (kernel.mode == 0) {
    total.up.resize(total.stride);
    total.down.resize(total.stride);
    result.radiance = {std::move(total.up), std::move(total.down)};
  }
  result.moments = std::move(sum);
  return result;
}

}  // namespace ifov::atmosphere
