#include "atmosphere/scattering/mode_operator.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/linear_source.h"

namespace ifov::atmosphere {

void add_scaled(std::size_t count, double factor, const double* __restrict from, double* __restrict to) {
  for (std::size_t i = 0; i < count; ++i) to[i] += factor * from[i];
}

namespace {

/// What is added to one row: factors of other rows. In their order, several in one pass, so that sums stay in registers.
struct Terms {
  static constexpr std::size_t kTogether = 4;
  std::size_t count = 0;
  double factor[kTogether] = {};
  const double* from[kTogether] = {};
};
void add_terms(std::size_t count, const Terms& terms, double* __restrict to) {
  const double *__restrict a = terms.from[0], *__restrict b = terms.from[1], *__restrict c = terms.from[2],
               *__restrict d = terms.from[3];
  const double fa = terms.factor[0], fb = terms.factor[1], fc = terms.factor[2], fd = terms.factor[3];
  switch (terms.count) {
    case 4:
      for (std::size_t i = 0; i < count; ++i) to[i] = to[i] + fa * a[i] + fb * b[i] + fc * c[i] + fd * d[i];
      return;
    case 3:
      for (std::size_t i = 0; i < count; ++i) to[i] = to[i] + fa * a[i] + fb * b[i] + fc * c[i];
      return;
    case 2:
      for (std::size_t i = 0; i < count; ++i) to[i] = to[i] + fa * a[i] + fb * b[i];
      return;
    case 1:
      for (std::size_t i = 0; i < count; ++i) to[i] = to[i] + fa * a[i];
      return;
    default: return;
  }
}
/// Adds terms to one row as they come.
class RowSum {
 public:
  RowSum(std::size_t count, double* to) : count_(count), to_(to) {}
  void add(double factor, const double* from) {
    terms_.factor[terms_.count] = factor;
    terms_.from[terms_.count] = from;
    if (++terms_.count == Terms::kTogether) finish();
  }
  void finish() {
    add_terms(count_, terms_, to_);
    terms_.count = 0;
  }

 private:
  std::size_t count_;
  double* to_;
  Terms terms_;
};

}  // namespace

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
  const std::size_t row = components_ * levels;
  std::vector<double> sum(nodes() * row), difference(nodes() * row);
  for (std::size_t j = 0; j < nodes(); ++j)
    for (int c = 0; c < components_; ++c) {
      const double *up = field.up_at(c, j), *down = field.down_at(c, j);
      double* __restrict both = sum.data() + j * row + c * levels, * __restrict apart = difference.data() +
                                                                                        j * row + c * levels;
      for (std::size_t i = 0; i < levels; ++i) {
        both[i] = up[i] + down[i];
        apart[i] = up[i] - down[i];
      }
    }
  for (int l = mode_; l < moments.terms; ++l) {
    const int at = l - mode_;
    const bool even = at % 2 == 0;
    RowSum i(levels, moments.at(l, 0)), q(levels, components_ > 1 ? moments.at(l, 1) : nullptr),
        u(levels, components_ > 2 ? moments.at(l, 2) : nullptr);
    for (std::size_t j = 0; j < nodes(); ++j) {
      const double weight = nodes_.weight[j];
      const double* same = (even ? sum : difference).data() + j * row;
      const double* other = (even ? difference : sum).data() + j * row;
      const SphericalFunctions& f = functions_[j];
      i.add(weight * f.p[at], same);
      if (components_ > 1) q.add(weight * f.r[at], same + levels);
      if (components_ > 2) {
        q.add(weight * f.t[at], other + 2 * levels);
        u.add(weight * f.t[at], other + levels);
        u.add(weight * f.r[at], same + 2 * levels);
      }
    }
    i.finish(), q.finish(), u.finish();
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
  for (int parity = 0; parity < 2; ++parity) {
    double* to = parity == 0 ? up.data() : down.data();
    RowSum i(n, to), q(n, components_ > 1 ? to + n : nullptr), u(n, components_ > 2 ? to + 2 * n : nullptr);
    for (int at = 0; at < static_cast<int>(f.p.size()); ++at) {
      const double* from = scattered.data() + static_cast<std::size_t>(at) * components_ * n;
      if (at % 2 == parity) {
        i.add(f.p[at], from);
        if (components_ > 1) q.add(f.r[at], from + n);
        if (components_ > 2) u.add(f.r[at], from + 2 * n);
      } else if (components_ > 2) {
        q.add(f.t[at], from + 2 * n);
        u.add(f.t[at], from + n);
      }
    }
    i.finish(), q.finish(), u.finish();
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
