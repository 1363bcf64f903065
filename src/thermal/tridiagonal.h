#pragma once

#include <vector>

namespace ifov::thermal {

struct Cells;

/// Elimination of the cells below the first, from the back to the surface, for steps that take `implicit_s` seconds of
/// the new rates: T_i = p_i + e_i T_(i-1), where T_(-1) is the surface's temperature.
class Tridiagonal {
 public:
  Tridiagonal(const Cells& cells, double implicit_s);

  double implicit_s() const { return implicit_s_; }
  /// Fills p, whose first entry and first_factor() give the first cell by the surface. `right`: C_i T_i plus what comes
  /// in at the old rates, and at the new one from what is behind.
  void eliminate(const std::vector<double>& right, std::vector<double>& p) const;
  double first_factor() const { return e_.front(); }
  /// All cells from the surface's temperature.
  void substitute(const std::vector<double>& p, double surface_k, std::vector<double>& cells_k) const;
  /// The solution where the surface takes part by a flux -loss T_0 into the first cell and no temperature of its own: in place.
  void solve_with_loss(double loss_w_m2_k, std::vector<double>& right, std::vector<double>& p) const;

 private:
  double implicit_s_;
  double first_diagonal_;            ///< of the first cell, without what the surface adds
  std::vector<double> e_, inverse_;  ///< factors, and 1 / diagonal after elimination
  std::vector<double> from_below_;   ///< implicit_s times the conductance to the next cell
  double surface_part_;              ///< implicit_s times the conductance to the surface
};

}  // namespace ifov::thermal
