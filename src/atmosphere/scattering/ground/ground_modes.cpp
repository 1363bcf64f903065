#include "atmosphere/scattering/ground/ground_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/scattering/ground/directional_ground.h"

namespace ifov::atmosphere {
namespace {

using std::numbers::pi;

constexpr int kOutNodes = 48;
constexpr int kAzimuths = 64;       // of the whole circle
constexpr int kSidesOfDiffuse = 3;  // azimuths of diffuse light, where the ground knows them

}  // namespace

GroundModes::GroundModes(const DirectionalGround& ground, double wavelength_um, const GaussNodes& in,
                         double sun_mu, int modes, bool polarized)
    : in_(in),
      out_(gauss_nodes(kOutNodes)),
      sun_mu_(sun_mu),
      modes_(std::min(modes, kAzimuths / 3)),
      components_(polarized && ground.polarizes() ? 3 : 1) {
  const std::size_t outs = out_.position.size(), ins = in_.position.size();
  const int c = components_;
  diffuse_.assign(static_cast<std::size_t>(modes_) * outs * ins * static_cast<std::size_t>(c * c), 0.0);
  beam_.assign(static_cast<std::size_t>(modes_) * outs * static_cast<std::size_t>(c), 0.0);
  // Midpoints, so that isotropic ground is asked on one side alone.
  const bool even = ground.is_isotropic();
  const int azimuths = even ? kAzimuths / 2 : kAzimuths;
  const double weight = 2.0 * pi / azimuths;
  std::vector<double> cosine, sine;  // [mode][azimuth]
  for (int m = 0; m < modes_; ++m)
    for (int a = 0; a < azimuths; ++a) {
      const double difference = 2.0 * pi * (a + 0.5) / kAzimuths;
      cosine.push_back(weight * std::cos(m * difference));
      sine.push_back(weight * std::sin(m * difference));
    }
  const int sides = even ? 1 : kSidesOfDiffuse;
  std::vector<GroundEvent> events;
  std::vector<GroundMatrix> brdf;
  const auto ask = [&](double in_mu, int first_sides) {
    events.clear();
    for (std::size_t o = 0; o < outs; ++o)
      for (int side = 0; side < first_sides; ++side)
        for (int a = 0; a < azimuths; ++a) {
          const double from = 2.0 * pi * side / first_sides;
          events.push_back({out_.position[o], -in_mu, from + 2.0 * pi * (a + 0.5) / kAzimuths, from});
        }
    brdf.resize(events.size());
    ground.reflect(wavelength_um, events, brdf);
  };
  for (std::size_t j = 0; j < ins; ++j) {
    ask(in_.position[j], sides);
    for (std::size_t o = 0; o < outs; ++o)
      for (int a = 0; a < azimuths; ++a) {
        GroundMatrix mean{};
        for (int side = 0; side < sides; ++side) {
          const std::size_t k = (o * static_cast<std::size_t>(sides) + static_cast<std::size_t>(side)) *
                                    static_cast<std::size_t>(azimuths) +
                                static_cast<std::size_t>(a);
          for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 3; ++column)
              mean[row][column] += brdf[k][row][column] / sides;
        }
        for (int m = 0; m < modes_; ++m) {
          const std::size_t k = static_cast<std::size_t>(m * azimuths + a);
          for (int row = 0; row < c; ++row)
            for (int column = 0; column < c; ++column) {
              const bool odd = (row == 2) != (column == 2);
              // Of light that goes as sin: -sin; I and Q of U change sign.
              const double part = odd ? (column == 2 ? -sine[k] : sine[k]) : cosine[k];
              diffuse_[at(m, o, j, row, column)] +=
                  part * mean[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
            }
        }
      }
  }
  if (!(sun_mu_ > 0.0)) return;
  ask(sun_mu_, 1);
  std::size_t next = 0;
  for (std::size_t o = 0; o < outs; ++o)
    for (int a = 0; a < azimuths; ++a, ++next)
      for (int m = 0; m < modes_; ++m) {
        const std::size_t k = static_cast<std::size_t>(m * azimuths + a);
        for (int row = 0; row < c; ++row)
          beam_[(static_cast<std::size_t>(m * c + row)) * outs + o] +=
              (row == 2 ? sine[k] : cosine[k]) * brdf[next][static_cast<std::size_t>(row)][0];
      }
}

GroundLight GroundModes::of_beam(int mode) const {
  const std::size_t outs = out_.position.size(), count = outs * static_cast<std::size_t>(components_);
  GroundLight light(count, 0.0);
  if (!(sun_mu_ > 0.0) || mode >= modes_) return light;
  const double strength = sun_mu_ * (mode == 0 ? 1.0 : 2.0) / (2.0 * pi);
  for (std::size_t k = 0; k < count; ++k)
    light[k] = strength * beam_[static_cast<std::size_t>(mode) * count + k];
  return light;
}

GroundLight GroundModes::of_diffuse(int mode, std::span<const double> down) const {
  const std::size_t outs = out_.position.size(), ins = in_.position.size();
  GroundLight light(outs * static_cast<std::size_t>(components_), 0.0);
  if (mode >= modes_) return light;
  const int given = static_cast<int>(down.size() / ins);  // mode 0 has no U
  for (std::size_t o = 0; o < outs; ++o)
    for (std::size_t j = 0; j < ins; ++j) {
      const double weight = in_.weight[j] * in_.position[j];
      for (int row = 0; row < components_; ++row)
        for (int column = 0; column < std::min(components_, given); ++column)
          light[static_cast<std::size_t>(row) * outs + o] += weight * diffuse_[at(mode, o, j, row, column)] *
                                                             down[static_cast<std::size_t>(column) * ins + j];
    }
  return light;
}

double GroundModes::exitance(const GroundLight& light) const {
  double sum = 0.0;
  for (std::size_t o = 0; o < out_.position.size(); ++o)
    sum += 2.0 * pi * out_.weight[o] * out_.position[o] * light[o];
  return sum;
}

radiometry::StokesVector GroundShape::radiance(double mu, double azimuth_rad) const {
  const std::vector<double>& nodes = out.position;
  const double x = std::clamp(mu, nodes.front(), nodes.back());
  const std::size_t above =
      static_cast<std::size_t>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
  const std::size_t first = std::min(above > 2 ? above - 2 : 0, nodes.size() - 4);
  double weight[4];
  for (std::size_t i = 0; i < 4; ++i) {
    weight[i] = 1.0;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) weight[i] *= (x - nodes[first + j]) / (nodes[first + i] - nodes[first + j]);
  }
  double sum[3] = {};
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const double angle = static_cast<double>(m) * azimuth_rad;
    for (int c = 0; c < components; ++c) {
      const double* values = modes[m].data() + static_cast<std::size_t>(c) * nodes.size() + first;
      double value = 0.0;
      for (std::size_t i = 0; i < 4; ++i) value += weight[i] * values[i];
      sum[c] += value * (c == 2 ? std::sin(angle) : std::cos(angle));
    }
  }
  return {sum[0], sum[1], sum[2], 0.0};
}

}  // namespace ifov::atmosphere
