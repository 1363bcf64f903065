#include "atmosphere/scattering/many_orders.h"

#include <cmath>
#include <utility>
#include <vector>

namespace ifov::atmosphere {
namespace {

constexpr int kMostDirections = 100, kRestarts = 4;

class ManyOrders {
 public:
  ManyOrders(const ModeOperator& step, double tolerance) : step_(step), tolerance_(tolerance) {}
  int steps = 0;
  ModeMoments solve(const ModeMoments& once) {
    ModeMoments sum = once;
    const double wanted = tolerance_ * norm(once.values);
    for (int restart = 0; restart < kRestarts; ++restart)
      if (improve(once, wanted, sum)) break;
    return sum;
  }

 private:
  using Vector = std::vector<double>;
  static double product(const Vector& a, const Vector& b) {
    constexpr std::size_t kLanes = 8;
    double lanes[kLanes] = {}, rest = 0.0;
    const std::size_t whole = a.size() / kLanes * kLanes;
    for (std::size_t i = 0; i < whole; i += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += a[i + k] * b[i + k];
    for (std::size_t i = whole; i < a.size(); ++i) rest += a[i] * b[i];
    for (const double lane : lanes) rest += lane;
    return rest;
  }
  static double norm(const Vector& a) { return std::sqrt(product(a, a)); }
  /// x - K x.
  Vector apply(const Vector& x) {
    ModeMoments moments = step_.empty_moments();
    moments.values = x;
    Vector result = step_.moments_of(step_.next(moments)).values;
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] - result[i];
    ++steps;
    return result;
  }
  bool improve(const ModeMoments& once, double wanted, ModeMoments& sum) {
    Vector residual = apply(sum.values);
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = once.values[i] - residual[i];
    const double length = norm(residual);
    if (!(length > wanted)) return true;
    std::vector<Vector> basis;
    std::vector<Vector> columns;  // of the Hessenberg matrix, turned into a triangle
    Vector cosines, sines, right{length};
    for (double& value : residual) value /= length;
    basis.push_back(std::move(residual));
    int k = 0;
    for (; k < kMostDirections; ++k) {
      Vector next = apply(basis.back());
      Vector column;
      for (const Vector& direction : basis) {
        column.push_back(product(direction, next));
        add_scaled(next.size(), -column.back(), direction.data(), next.data());
      }
      const double rest = norm(next);
      for (int j = 0; j < k; ++j) {
        const double turned = cosines[j] * column[j] + sines[j] * column[j + 1];
        column[j + 1] = cosines[j] * column[j + 1] - sines[j] * column[j];
        column[j] = turned;
      }
      const double radius = std::hypot(column[k], rest);
      cosines.push_back(column[k] / radius);
      sines.push_back(rest / radius);
      column[k] = radius;
      columns.push_back(std::move(column));
      right.push_back(-sines[k] * right[k]);
      right[k] *= cosines[k];
      if (std::abs(right[k + 1]) <= wanted || !(rest > 0.0)) {
        ++k;
        break;
      }
      for (double& value : next) value /= rest;
      basis.push_back(std::move(next));
    }
    Vector weights(k);
    for (int i = k - 1; i >= 0; --i) {
      double value = right[i];
      for (int j = i + 1; j < k; ++j) value -= columns[j][i] * weights[j];
      weights[i] = value / columns[i][i];
    }
    for (int i = 0; i < k; ++i) add_scaled(sum.values.size(), weights[i], basis[i].data(), sum.values.data());
    return std::abs(right[k]) <= wanted;
  }
  const ModeOperator& step_;
  double tolerance_;
};

}  // namespace

AllOrders all_orders(const ModeOperator& step, const ModeMoments& once, double tolerance) {
  ManyOrders orders(step, tolerance);
  ModeMoments moments = orders.solve(once);
  return {std::move(moments), orders.steps};
}

}  // namespace ifov::atmosphere
