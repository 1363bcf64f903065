#include "thermal/tridiagonal.h"

#include "thermal/cells.h"

namespace ifov::thermal {

Tridiagonal::Tridiagonal(const Cells& cells, double implicit_s) : implicit_s_(implicit_s) {
  const std::size_t count = cells.capacity_j_m2_k.size();
  e_.resize(count);
  inverse_.resize(count);
  from_below_.assign(count, 0.0);
  for (std::size_t i = 0; i + 1 < count; ++i) from_below_[i] = implicit_s * cells.conductance_w_m2_k[i + 1];
  surface_part_ = implicit_s * cells.conductance_w_m2_k[0];
  for (std::size_t i = count; i-- > 0;) {
    const double above = implicit_s * cells.conductance_w_m2_k[i];
    double diagonal = cells.capacity_j_m2_k[i];
    if (i + 1 < count)
      diagonal += from_below_[i] * (1.0 - e_[i + 1]);
    else
      diagonal += implicit_s * cells.back_conductance_w_m2_k;
    if (i == 0) first_diagonal_ = diagonal;
    inverse_[i] = 1.0 / (diagonal + above);
    e_[i] = above * inverse_[i];
  }
}

void Tridiagonal::eliminate(const std::vector<double>& right, std::vector<double>& p) const {
  const std::size_t count = e_.size();
  p.resize(count);
  p[count - 1] = right[count - 1] * inverse_[count - 1];
  for (std::size_t i = count - 1; i-- > 0;) p[i] = (right[i] + from_below_[i] * p[i + 1]) * inverse_[i];
}

void Tridiagonal::substitute(const std::vector<double>& p, double surface_k,
                             std::vector<double>& cells_k) const {
  double above_k = surface_k;
  for (std::size_t i = 0; i < e_.size(); ++i) {
    above_k = p[i] + e_[i] * above_k;
    cells_k[i] = above_k;
  }
}

void Tridiagonal::solve_with_loss(double loss_w_m2_k, std::vector<double>& right,
                                  std::vector<double>& p) const {
  eliminate(right, p);
  // The first row again, with the loss in place of the surface: p_0 / inverse_0 is its right side after elimination.
  double above_k = p[0] / inverse_[0] / (first_diagonal_ + implicit_s_ * loss_w_m2_k);
  right[0] = above_k;
  for (std::size_t i = 1; i < e_.size(); ++i) {
    above_k = p[i] + e_[i] * above_k;
    right[i] = above_k;
  }
}

}  // namespace ifov::thermal
