#include "sampling/accuracy/radiance/sequence_gains.h"

#include <algorithm>
#include <cmath>

namespace ifov::sampling {

namespace {

/// So many outputs tell how like they are.
constexpr double kFewestLike = 40.0;
/// An output tells of others by so many degrees of freedom at least: where there are fewer, its logarithm says little.
constexpr double kOwnTelling = 4.0;
/// Like outputs count for at most so many degrees of freedom beside an output's own.
constexpr double kMost = 60.0;

/// Of log(chi^2_nu / nu): expectation and variance, digamma(nu / 2) - log(nu / 2) and trigamma(nu / 2) by their asymptotic series
/// (Abramowitz and Stegun 1964, 6.3.18 and 6.4.12), to 0.2 % from nu = 4 on.
double expected_log(double nu) { return -1.0 / nu - 1.0 / (3.0 * nu * nu); }
double variance_of_log(double nu) { return (2.0 + (2.0 + 4.0 / (3.0 * nu)) / nu) / nu; }

}  // namespace

void SequenceGains::add(std::uint32_t label, SequenceGain own, double count) {
  if (own.freedom < kOwnTelling || !(own.value > 0.0) || !(count > 0.0)) return;
  Pool& pool = pools_[label];
  const double x = std::log(count), z = std::log(own.value) - expected_log(own.freedom);
  pool.lowest = pool.n == 0.0 ? x : std::min(pool.lowest, x);
  pool.highest = pool.n == 0.0 ? x : std::max(pool.highest, x);
  pool.n += 1.0;
  pool.x += x;
  pool.z += z;
  pool.xx += x * x;
  pool.xz += x * z;
  pool.zz += z * z;
  pool.scatter += variance_of_log(own.freedom);
}

void SequenceGains::settle() {
  for (auto& [label, pool] : pools_) {
    if (pool.n >= kFewestLike) {
      settle(pool);
      continue;
    }
    rest_.lowest = rest_.n == 0.0 ? pool.lowest : std::min(rest_.lowest, pool.lowest);
    rest_.highest = rest_.n == 0.0 ? pool.highest : std::max(rest_.highest, pool.highest);
    rest_.n += pool.n;
    rest_.x += pool.x;
    rest_.z += pool.z;
    rest_.xx += pool.xx;
    rest_.xz += pool.xz;
    rest_.zz += pool.zz;
    rest_.scatter += pool.scatter;
  }
  if (rest_.n >= kFewestLike) settle(rest_);
}

void SequenceGains::settle(Pool& pool) {
  const double n = pool.n, x = pool.x / n, z = pool.z / n;
  const double xx = std::max(0.0, pool.xx - n * x * x), xz = pool.xz - n * x * z, zz = pool.zz - n * z * z;
  // Numbers that hardly differ tell no slope.
  pool.slope = xx > 0.01 * n ? xz / xx : 0.0;
  pool.level = z - pool.slope * x;
  const double apart = (zz - pool.slope * xz) / (n - 2.0) - pool.scatter / n;
  // Of a variance with nu degrees of freedom the logarithm has about 2 / nu + 2 / nu^2.
  pool.freedom = apart <= 2.0 / kMost ? kMost : std::min(kMost, (1.0 + std::sqrt(1.0 + 2.0 * apart)) / apart);
}

const SequenceGains::Pool* SequenceGains::pool_of(std::uint32_t label) const {
  const auto found = pools_.find(label);
  const Pool* pool = found != pools_.end() && found->second.freedom > 0.0 ? &found->second : &rest_;
  return pool->freedom > 0.0 ? pool : nullptr;
}

SequenceGain SequenceGains::moderated(std::uint32_t label, SequenceGain own, double count) const {
  const Pool* pool = pool_of(label);
  if (pool == nullptr || !(own.freedom > 0.0) || !(count > 0.0)) return own;
  const double x = std::clamp(std::log(count), pool->lowest, pool->highest);
  const double like = std::exp(pool->level + pool->slope * x + expected_log(pool->freedom));
  const double freedom = own.freedom + pool->freedom;
  return {(own.freedom * own.value + pool->freedom * like) / freedom, freedom};
}

}  // namespace ifov::sampling
