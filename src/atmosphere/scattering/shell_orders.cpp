#include "atmosphere/scattering/shell_orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/gauss_nodes.h"
#include "atmosphere/scattering/shell_rays.h"

namespace ifov::atmosphere {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDark = 1e-36;  // as dark as a float may be
constexpr int kMostOrders = 30;
constexpr double kTolerance = 2e-3;

}  // namespace

/// Of an order, [altitude][angle]: mean of the radiance over all directions, and of it times the direction's cosine with the
/// vertical and with the horizontal towards the Sun.
struct ShellOrders::Light {
  explicit Light(std::size_t count = 0)
      : mean(count, 0.0), up(count, 0.0), sunward(count, 0.0), log_mean(count, 0.0) {}
  std::vector<double> mean, up, sunward, log_mean;
  /// The logarithm, and the others as shares of the mean.
  void relate(std::size_t i) {
    log_mean[i] = std::log(std::max(mean[i], kDark));
    const double inverse = mean[i] > kDark ? 1.0 / mean[i] : 0.0;
    up[i] *= inverse, sunward[i] *= inverse;
  }
};
/// Along rays of one zenith angle, by the Sun's: means over the azimuth of what arrives, and of it times the azimuth's cosine.
struct ShellOrders::Arriving {
  std::vector<double> even, turned;
};

ShellOrders::ShellOrders(const ScatteringColumn& column, const Geometry& geometry,
                         std::span<const double> sun_zenith_rad, std::size_t own, const Fineness& fineness)
    : column_(column), geometry_(geometry), angle_rad_(sun_zenith_rad.begin(), sun_zenith_rad.end()) {
  choose_altitudes(fineness.dusk);
  tabulate_beams(fineness.dusk);
  const GaussNodes nodes = gauss_nodes(fineness.nodes);
  const std::size_t altitudes = altitude_km_.size(), angles = angle_rad_.size(),
                    count = nodes.position.size();
  std::vector<Ray> rays;  // [altitude][node][up, down]
  for (const double altitude : altitude_km_)
    for (const double mu : nodes.position)
      for (const double side : {1.0, -1.0}) {
        rays.push_back(ray(altitude, side * mu, fineness.longest_km));
        if (geometry.sun_turns) add_suns(side * mu, fineness.azimuths, rays.back());
      }

  Light sum(altitudes * angles), last, light(altitudes * angles);
  std::vector<double> flux(altitudes, 0.0), added(altitudes);
  Arriving arriving{std::vector<double>(angles), std::vector<double>(angles)};
  for (int order = 1;; ++order) {
    light = Light(altitudes * angles);
    std::fill(added.begin(), added.end(), 0.0);
    const Light* before = order == 1 ? nullptr : &last;
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const std::size_t z = r / (2 * count), j = r / 2 % count;
      const bool looks_up = r % 2 == 0;
      const double mu = looks_up ? nodes.position[j] : -nodes.position[j], sine = std::sqrt(1.0 - mu * mu),
                   weight = 0.5 * nodes.weight[j];
      if (geometry.sun_turns)
        add_turning(rays[r], mu, fineness.azimuths, before, arriving);
      else
        add_still(rays[r], mu, fineness.azimuths, before, arriving);
      for (std::size_t k = 0; k < angles; ++k) {
        const std::size_t at = z * angles + k;
        light.mean[at] += weight * arriving.even[k];
        light.up[at] += weight * mu * arriving.even[k];
        light.sunward[at] += weight * sine * arriving.turned[k];
      }
      if (looks_up) added[z] += 2.0 * kPi * nodes.weight[j] * mu * arriving.even[own];
    }
    // The orders become geometric: the last one stands for all that follow.
    const double largest = *std::max_element(light.mean.begin(), light.mean.end());
    double share = 0.0;
    for (std::size_t i = 0; i < sum.mean.size(); ++i)
      if (sum.mean[i] > 0.0) share = std::max(share, light.mean[i] / sum.mean[i]);
    const double earlier = order == 1 ? 0.0 : *std::max_element(last.mean.begin(), last.mean.end());
    const double ratio = earlier > 0.0 ? std::min(0.97, largest / earlier) : 0.0;
    const bool end = order == kMostOrders || (order > 1 && share < kTolerance) || !(largest > kDark);
    const double factor = end ? 1.0 / (1.0 - ratio) : 1.0;
    for (std::size_t i = 0; i < sum.mean.size(); ++i) {
      sum.mean[i] += factor * light.mean[i];
      sum.up[i] += factor * light.up[i];
      sum.sunward[i] += factor * light.sunward[i];
    }
    for (std::size_t z = 0; z < altitudes; ++z) flux[z] += factor * added[z];
    if (end) break;
    last = light;
    if (!geometry.sun_turns) continue;
    // Along rays that turn: logarithms, and shares of them.
    for (std::size_t i = 0; i < last.mean.size(); ++i) last.relate(i);
  }
  for (std::size_t i = 0; i < sum.mean.size(); ++i) sum.relate(i);
  log_mean_ = std::move(sum.log_mean), up_ = std::move(sum.up), sunward_ = std::move(sum.sunward);
  for (const double value : flux) log_flux_.push_back(std::log(std::max(value, kDark)));
}

/// Where the Sun is as high all along the ray. `before`: of the order before; none: sunlight.
void ShellOrders::add_still(const Ray& ray, double mu, int azimuths, const Light* before,
                            Arriving& arriving) const {
  const std::size_t angles = angle_rad_.size();
  const double sine = std::sqrt(1.0 - mu * mu);
  std::vector<double> turns;  // cosines of azimuths
  for (int a = 0; a < azimuths; ++a) turns.push_back(std::cos((a + 0.5) * kPi / azimuths));
  std::vector<double> forward(turns.size());  // what aerosol scatters of the sunbeam, by azimuth
  for (std::size_t k = 0; k < angles; ++k) {
    const double along_vertical = mu * std::cos(angle_rad_[k]), across = sine * std::sin(angle_rad_[k]);
    const auto at = [&](const End& end, const std::vector<double>& values) {
      const double* low = values.data() + end.low * angles + k;
      return (1.0 - end.high_share) * low[0] + end.high_share * low[angles];
    };
    const auto sunbeam = [&](const End& end) {
      const double* low = beam_.data() + end.layer * angles + k;
      return (1.0 - end.below) * low[0] + end.below * low[angles];
    };
    // Of light that is scattered again: its mean, and that of it times the cosine with the vertical and with the ray's horizontal.
    struct Source {
      double mean = 0.0, along = 0.0, across = 0.0;
    };
    const auto light = [&](const End& end) -> Source {
      if (before == nullptr) return {sunbeam(end), 0.0, 0.0};
      return {at(end, before->mean), end.mu * at(end, before->up), end.level * at(end, before->sunward)};
    };
    double transmission = 1.0, even = 0.0, turned = 0.0;
    double asymmetry = 2.0;  // of what `forward` is for: layers of one follow each other
    Source near = ray.ends.empty() ? Source{} : light(ray.ends.front());
    for (std::size_t p = 0; p < ray.pieces.size(); ++p) {
      const Piece& piece = ray.pieces[p];
      // The light at a boundary is that of the layer entered: layers' ends are shared.
      const Source far = light(ray.ends[p + 1]);
      const double near_weight = transmission * piece.step.near, far_weight = transmission * piece.step.far;
      if (before == nullptr) {
        if (piece.asymmetry != asymmetry) {
          asymmetry = piece.asymmetry;
          for (std::size_t a = 0; a < turns.size(); ++a)
            forward[a] = piece.by_aerosol(along_vertical + across * turns[a]);
        }
        const double mean = (near_weight * near.mean + far_weight * far.mean) / azimuths;
        for (std::size_t a = 0; a < turns.size(); ++a) {
          const double scattered = piece.scattered(along_vertical + across * turns[a], forward[a]) * mean;
          even += scattered;
          turned += turns[a] * scattered;
        }
      } else if (piece.is_whole(near.mean, near.along, near.across) &&
                 piece.is_whole(far.mean, far.along, far.across)) {
        even +=
            near_weight * piece.again(near.mean, near.along) + far_weight * piece.again(far.mean, far.along);
        turned += 0.5 * piece.kept() * (near_weight * near.across + far_weight * far.across);
      } else {
        // Azimuths one by one, as where the Sun turns: what a pattern of two terms lacks is not the same of their mean.
        for (const double turn : turns) {
          const double scattered = (near_weight * piece.again(near.mean, near.along + turn * near.across) +
                                    far_weight * piece.again(far.mean, far.along + turn * far.across)) /
                                   azimuths;
          even += scattered;
          turned += turn * scattered;
        }
      }
      transmission *= piece.step.transmission;
      near = far;
    }
    arriving.even[k] = even;
    arriving.turned[k] = turned;
  }
}

/// The same with the Sun's height at each place, by azimuths.
void ShellOrders::add_turning(const Ray& ray, double mu, int azimuths, const Light* before,
                              Arriving& arriving) const {
  const std::size_t angles = angle_rad_.size(), ends = ray.ends.size();
  const double sine = std::sqrt(1.0 - mu * mu);
  const double beam_most = static_cast<double>(beam_angles_ - 1) - 1e-9;
  struct Source {
    double mean = 0.0, along = 0.0;
  };
  for (std::size_t k = 0; k < angles; ++k) {
    arriving.even[k] = arriving.turned[k] = 0.0;
    for (int a = 0; a < azimuths; ++a) {
      const std::size_t first = (k * static_cast<std::size_t>(azimuths) + static_cast<std::size_t>(a)) * ends;
      const float *sun = ray.sun_rad.data() + first, *places = ray.place.data() + first,
                  *sunward = ray.sunward.data() + first;
      const auto light = [&](std::size_t e) -> Source {
        const End& end = ray.ends[e];
        if (before == nullptr) {
          const double place = std::clamp((sun[e] - beam_first_rad_) / beam_step_rad_, 0.0, beam_most);
          const std::size_t at = static_cast<std::size_t>(place);
          const double share = place - static_cast<double>(at);
          const double *above = beam_.data() + end.layer * beam_angles_ + at, *below = above + beam_angles_;
          return {(1.0 - end.below) * ((1.0 - share) * above[0] + share * above[1]) +
                      end.below * ((1.0 - share) * below[0] + share * below[1]),
                  0.0};
        }
        const double place = places[e];
        const std::size_t at = static_cast<std::size_t>(place), low = end.low * angles + at;
        const double share = place - static_cast<double>(at);
        // Logarithms between the Sun's angles, light itself between altitudes, as along rays that do not turn: what steps in
        // altitude are too coarse for is the same in both. In floats, twice as fast, and good to 1e-5.
        const auto mean_at = [&](std::size_t i) {
          return static_cast<double>(std::exp(
              static_cast<float>((1.0 - share) * before->log_mean[i] + share * before->log_mean[i + 1])));
        };
        const auto between = [&](const std::vector<double>& values, std::size_t i) {
          return (1.0 - share) * values[i] + share * values[i + 1];
        };
        const std::size_t high = low + angles;
        const double below = (1.0 - end.high_share) * mean_at(low), above = end.high_share * mean_at(high);
        return {below + above,
                end.mu * (below * between(before->up, low) + above * between(before->up, high)) +
                    sunward[e] *
                        (below * between(before->sunward, low) + above * between(before->sunward, high))};
      };
      const double turn = std::cos((a + 0.5) * kPi / azimuths);
      const double along = mu * std::cos(angle_rad_[k]) + sine * std::sin(angle_rad_[k]) * turn;
      double transmission = 1.0, sum = 0.0;
      Source near = ends == 0 ? Source{} : light(0);
      for (std::size_t p = 0; p < ray.pieces.size(); ++p) {
        const Piece& piece = ray.pieces[p];
        const Source far = light(p + 1);
        sum += transmission * (before == nullptr ? piece.scattered(along) * (piece.step.near * near.mean +
                                                                             piece.step.far * far.mean)
                                                 : piece.step.near * piece.again(near.mean, near.along) +
                                                       piece.step.far * piece.again(far.mean, far.along));
        transmission *= piece.step.transmission;
        near = far;
      }
      arriving.even[k] += sum / azimuths;
      arriving.turned[k] += turn * sum / azimuths;
    }
  }
}

}  // namespace ifov::atmosphere
