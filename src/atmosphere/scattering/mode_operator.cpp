#include "atmosphere/scattering/mode_operator.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/linear_source.h"

namespace ifov::atmosphere {

void add_scaled(std::size_t count, double factor, const double* __restrict from, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += factor * from[i];
}

double ModeMoments::peak() const {
  // Several at once: the compiler may not reorder a single maximum.
  constexpr std::size_t kLanes = 16;
  double largest[kLanes] = {};
  const auto take = [](double& best, double value) {
    best = std::abs(value) > best ? std::abs(value) : best;
  };
  const std::size_t whole = values.size() / kLanes * kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) take(largest[k], values[i + k]);
  for (std::size_t i = whole; i < values.size(); ++i) take(largest[0], values[i]);
  return *std::max_element(largest, largest + kLanes);
}

NodeSteps::NodeSteps(const ScatteringColumn& column, const GaussNodes& nodes) {
  for (double mu : nodes.position) {
    for (double depth : column.depth) {
      const LinearSource step = LinearSource::over(depth / mu);
      transmission.push_back(step.transmission);
      near.push_back(step.near);
      far.push_back(step.far);
    }
  }
}

ModeOperator::ModeOperator(const ScatteringColumn& column, const ColumnPhase& phase, const GaussNodes& nodes,
                           const NodeSteps& steps, int mode, bool polarized)
    : column_(column),
      phase_(phase),
      nodes_(nodes),
      steps_(steps),
      mode_(mode),
      components_(polarized ? (mode == 0 ? 2 : 3) : 1) {
  for (double mu : nodes.position) functions_.push_back(spherical_functions(mode, phase.terms, mu));
}

ModeMoments ModeOperator::empty_moments() const {
  ModeMoments moments{mode_, phase_.terms, components_, sublayers() + 1, {}};
  moments.values.assign(static_cast<std::size_t>(moments.terms - mode_) * components_ * moments.levels, 0.0);
  return moments;
}

ModeMoments ModeOperator::moments_of(const ModeField& field) const {
  const std::size_t levels = sublayers() + 1;
  ModeMoments moments = empty_moments();
  std::vector<double> sum(components_ * levels), difference(components_ * levels);
  for (std::size_t j = 0; j < nodes(); ++j) {
    const double weight = nodes_.weight[j];
    for (int c = 0; c < components_; ++c) {
      const double *up = field.up_at(c, j), *down = field.down_at(c, j);
      for (std::size_t i = 0; i < levels; ++i) {
        sum[c * levels + i] = up[i] + down[i];
        difference[c * levels + i] = up[i] - down[i];
      }
    }
    for (int l = mode_; l < moments.terms; ++l) {
      const bool even = (l - mode_) % 2 == 0;
      const double* same = even ? sum.data() : difference.data();
      const double* other = even ? difference.data() : sum.data();
      const SphericalFunctions& f = functions_[j];
      const int at = l - mode_;
      add_scaled(levels, weight * f.p[at], same, moments.at(l, 0));
      if (components_ > 1) add_scaled(levels, weight * f.r[at], same + levels, moments.at(l, 1));
      if (components_ > 2) {
        add_scaled(levels, weight * f.t[at], other + 2 * levels, moments.at(l, 1));
        add_scaled(levels, weight * f.t[at], other + levels, moments.at(l, 2));
        add_scaled(levels, weight * f.r[at], same + 2 * levels, moments.at(l, 2));
      }
    }
  }
  return moments;
}

std::vector<double> ModeOperator::scatter(const ModeMoments& moments, std::size_t offset) const {
  const std::size_t n = sublayers();
  std::vector<double> result(static_cast<std::size_t>(moments.terms - mode_) * components_ * n);
  for (int l = mode_; l < moments.terms; ++l) {
    double* to = result.data() + static_cast<std::size_t>(l - mode_) * components_ * n;
    const double *beta = phase_.at(phase_.beta, l), *gamma = phase_.at(phase_.gamma, l);
    const double *alpha = phase_.at(phase_.alpha, l), *zeta = phase_.at(phase_.zeta, l);
    const double* i = moments.at(l, 0) + offset;
    if (components_ == 1) {
      for (std::size_t s = 0; s < n; ++s) to[s] = beta[s] * i[s];
      continue;
    }
    const double* q = moments.at(l, 1) + offset;
    for (std::size_t s = 0; s < n; ++s) {
      to[s] = beta[s] * i[s] + gamma[s] * q[s];
      to[n + s] = gamma[s] * i[s] + alpha[s] * q[s];
    }
    if (components_ < 3) continue;
    const double* u = moments.at(l, 2) + offset;
    for (std::size_t s = 0; s < n; ++s) to[2 * n + s] = zeta[s] * u[s];
  }
  return result;
}

void ModeOperator::expand(std::size_t j, const std::vector<double>& scattered, std::vector<double>& up,
                          std::vector<double>& down) const {
  const std::size_t n = sublayers();
  std::fill(up.begin(), up.end(), 0.0);      // first the part that is even in mu,
  std::fill(down.begin(), down.end(), 0.0);  // and here the odd part
  const SphericalFunctions& f = functions_[j];
  for (int at = 0; at < static_cast<int>(f.p.size()); ++at) {
    const double* from = scattered.data() + static_cast<std::size_t>(at) * components_ * n;
    double* same = at % 2 == 0 ? up.data() : down.data();
    double* other = at % 2 == 0 ? down.data() : up.data();
    add_scaled(n, f.p[at], from, same);
    if (components_ > 1) add_scaled(n, f.r[at], from + n, same + n);
    if (components_ > 2) {
      add_scaled(n, f.t[at], from + 2 * n, other + n);
      add_scaled(n, f.t[at], from + n, other + 2 * n);
      add_scaled(n, f.r[at], from + 2 * n, same + 2 * n);
    }
  }
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double even = up[i], odd = down[i];
    up[i] = even + odd;
    down[i] = even - odd;
  }
}

ModeField ModeOperator::next(const ModeMoments& moments) const {
  const std::size_t n = sublayers();
  const std::vector<double> top = scatter(moments, 0), bottom = scatter(moments, 1);
  ModeField field = empty_field();
  std::vector<double> up_top(components_ * n), down_top(up_top), up_bottom(up_top), down_bottom(up_top);
  for (std::size_t j = 0; j < nodes(); ++j) {
    expand(j, top, up_top, down_top);
    expand(j, bottom, up_bottom, down_bottom);
    const double *near = steps_.near.data() + j * n, *far = steps_.far.data() + j * n;
    for (int c = 0; c < components_; ++c) {
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

void ModeOperator::sweep(std::size_t j, const std::vector<double>& up_gain,
                         const std::vector<double>& down_gain, ModeField& field) const {
  const std::size_t n = sublayers();
  const double* t = steps_.transmission.data() + j * n;
  for (int c = 0; c < components_; ++c) {
    double *up = field.up_at(c, j), *down = field.down_at(c, j);
    for (std::size_t s = 0; s < n; ++s) {
      down[s + 1] = down[s] * t[s] + down_gain[c * n + s];
      const std::size_t r = n - 1 - s;
      up[r] = up[r + 1] * t[r] + up_gain[c * n + r];
    }
  }
}

}  // namespace ifov::atmosphere
