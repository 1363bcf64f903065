#include "geodesy/orbit/free_orbit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace ifov::geodesy {
namespace {

using math::Vec3;

// EGM2008.
constexpr double kGm_m3_s2 = 3.986004415e14, kRadius_m = 6378136.3;
// The pole's distance from the centre, less than which nothing flies.
constexpr double kGround_m = 6356752.0;

struct Phase {
  Vec3 position_m, velocity_m_s;
};

Vec3 from_centre(PointIn<Gcrs> point) { return point.p - math::Point3{}; }

}  // namespace

FreeOrbit::FreeOrbit(const CelestialState& start, GcrsVector pole, const Zonals& zonals)
    : state_(start), pole_(math::normalized(pole.v)), zonals_(zonals) {
  const double away_m = math::length(from_centre(start.position));
  if (!(away_m > kGround_m))
    throw InputError(
        format("the orbit's position is {:.6g} km from the Earth's centre, inside the Earth", 1e-3 * away_m));
}

Vec3 FreeOrbit::acceleration(Vec3 r) const {
  // The gradient of GM/r (1 - sum J_n (R/r)^n P_n(u)), u = z/r.
  const double distance = math::length(r), u = math::dot(r, pole_) / distance, q = kRadius_m / distance;
  const double p2 = 1.5 * u * u - 0.5, p3 = u * (2.5 * u * u - 1.5),
               p4 = (4.375 * u * u - 3.75) * u * u + 0.375;
  const double d2 = 3.0 * u, d3 = 7.5 * u * u - 1.5, d4 = u * (17.5 * u * u - 7.5);  // derivatives by u
  const double a2 = zonals_.j2 * q * q, a3 = zonals_.j3 * q * q * q, a4 = zonals_.j4 * q * q * q * q;
  const double radial =
      -1.0 + 3.0 * a2 * p2 + 4.0 * a3 * p3 + 5.0 * a4 * p4 + u * (a2 * d2 + a3 * d3 + a4 * d4);
  const double polar = -(a2 * d2 + a3 * d3 + a4 * d4);
  const double strength = kGm_m3_s2 / (distance * distance);
  return strength * (radial * (r * (1.0 / distance)) + polar * pole_);
}

double FreeOrbit::energy(const CelestialState& state) const {
  const Vec3 r = from_centre(state.position), v = state.velocity_m_s.v;
  const double distance = math::length(r), u = math::dot(r, pole_) / distance, q = kRadius_m / distance;
  const double p2 = 1.5 * u * u - 0.5, p3 = u * (2.5 * u * u - 1.5),
               p4 = (4.375 * u * u - 3.75) * u * u + 0.375;
  return 0.5 * math::dot(v, v) -
         kGm_m3_s2 / distance *
             (1.0 - zonals_.j2 * q * q * p2 - zonals_.j3 * q * q * q * p3 - zonals_.j4 * q * q * q * q * p4);
}

bool FreeOrbit::step(double seconds) {
  constexpr int kColumns = 8;
  constexpr double kClose_m = 1e-8;
  const Vec3 r0 = from_centre(state_.position), v0 = state_.velocity_m_s.v, a0 = acceleration(r0);
  std::array<Phase, kColumns> column;
  for (int k = 0; k < kColumns; ++k) {
    // The modified midpoint rule in 2, 4, 6, ... steps, whose error is a series in the square of the step.
    const int count = 2 * (k + 1);
    const double h = seconds / count;
    Phase before{r0, v0}, now{r0 + h * v0, v0 + h * a0};
    for (int j = 1; j < count; ++j) {
      const Phase next{before.position_m + 2.0 * h * now.velocity_m_s,
                       before.velocity_m_s + 2.0 * h * acceleration(now.position_m)};
      before = now, now = next;
    }
    Phase found{0.5 * (before.position_m + now.position_m + h * now.velocity_m_s),
                0.5 * (before.velocity_m_s + now.velocity_m_s + h * acceleration(now.position_m))};
    double off_m = 1.0;
    for (int m = 1; m <= k; ++m) {
      Phase& held = column[static_cast<std::size_t>(m - 1)];  // of the row before
      const double ratio = static_cast<double>(k + 1) / (k + 1 - m), share = 1.0 / (ratio * ratio - 1.0);
      const Vec3 more_m = share * (found.position_m - held.position_m),
                 more_m_s = share * (found.velocity_m_s - held.velocity_m_s);
      held = found;
      found = {found.position_m + more_m, found.velocity_m_s + more_m_s};
      off_m = math::length(more_m) + std::abs(seconds) * math::length(more_m_s);
    }
    column[static_cast<std::size_t>(k)] = found;
    if (k > 1 && off_m < kClose_m) {
      state_ = {{math::Point3{} + found.position_m}, {found.velocity_m_s}};
      return true;
    }
  }
  return false;
}

const CelestialState& FreeOrbit::to(double seconds) {
  constexpr double kShortest_s = 1e-3, kLongest_s = 300.0;
  while (now_s_ != seconds) {
    const double left_s = seconds - now_s_;
    const double taken_s = std::copysign(std::min(step_s_, std::abs(left_s)), left_s);
    if (!step(taken_s)) {
      step_s_ = 0.5 * std::abs(taken_s);
      if (step_s_ < kShortest_s)
        throw InputError(format("the orbit cannot be followed beyond {:.6g} s from its epoch", now_s_));
      continue;
    }
    now_s_ = std::abs(taken_s) == std::abs(left_s) ? seconds : now_s_ + taken_s;
    if (std::abs(taken_s) == step_s_) step_s_ = std::min(1.5 * step_s_, kLongest_s);
    if (!(math::length(from_centre(state_.position)) > kGround_m))
      throw InputError(format("the orbit meets the ground within {:.0f} s of its epoch", std::abs(now_s_)));
  }
  return state_;
}

}  // namespace ifov::geodesy
