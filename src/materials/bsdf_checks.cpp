#include "materials/bsdf_checks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "math/angle.h"
#include "math/chi_square.h"
#include "sampling/random.h"

namespace ifov::materials {
namespace {

using std::numbers::pi;

/// A table that is brighter to the sides and towards the light.
MeasuredBrdf bowl() {
  MeasuredBrdf table{{0.0, 0.5, 1.0, 1.4}, {0.0, 0.7, 1.2}, {0.0, 1.0, pi}, {0.4, 1.0}, {}};
  for (const double in : table.zenith_in_rad)
    for (const double out : table.zenith_out_rad)
      for (const double azimuth : table.azimuth_rad)
        for (const double um : table.wavelength_um)
          table.brdf.push_back(um * (0.05 + 0.01 * (in + out) + 0.01 * in * out * (1.0 + std::cos(azimuth))));
  return table;
}

}  // namespace

BsdfInputs inputs_within_ranges(const BsdfModel& model, double share) {
  BsdfInputs inputs{radiometry::Spectrum({0.4, 1.0}, {0.3, 0.6}), {}};
  for (const BsdfParameter& p : model.parameters) {
    if (p.key == "proteins" || p.key == "carbon") continue;
    const double number = p.low + share * (p.high - p.low);
    switch (p.form) {
      case BsdfParameter::Form::word:
        if (!p.optional) {
          const auto words = p.choices();
          inputs.values.emplace_back(p.key, std::string(share > 0.5 ? words.back() : words.front()));
        }
        break;
      case BsdfParameter::Form::spectrum:
        inputs.values.emplace_back(
            p.key, radiometry::Spectrum({0.4, 1.0}, {p.low + 0.4 * share, p.low + 0.2 + share}));
        break;
      case BsdfParameter::Form::brdf_file: inputs.values.emplace_back(p.key, bowl()); break;
      case BsdfParameter::Form::angle: inputs.values.emplace_back(p.key, number * math::kDegree); break;
      case BsdfParameter::Form::length: inputs.values.emplace_back(p.key, number * 1e-3); break;
      case BsdfParameter::Form::number:
      case BsdfParameter::Form::flag: inputs.values.emplace_back(p.key, number); break;
    }
  }
  return inputs;
}

BsdfEvent view_of(math::Vec3 outgoing, Side side) { return {outgoing, {}, {0, 0, 1}, {1, 0, 0}, side}; }

double brdf_at(const Bsdf& bsdf, const BsdfEvent& event, double um) {
  if (bsdf.is_separable()) return bsdf.shape(event);
  std::vector<float> values;
  std::vector<const float*> rows;
  for (const radiometry::Spectrum& spectrum : bsdf.spectra())
    values.push_back(static_cast<float>(spectrum.at(um)));
  for (const float& value : values) rows.push_back(&value);
  float found = 0.0f;
  bsdf.evaluate(event, rows, 1, &found);
  return static_cast<double>(found);
}

double samples_against_density(const Bsdf& bsdf, math::Vec3 out, double width_x, double width_y, int draws) {
  constexpr int kRings = 16, kSectors = 8, kFine = 32;
  const double highest = std::asinh(100.0 / std::min(width_x, width_y));
  const BsdfEvent view = view_of(out);
  std::vector<double> counted(kRings * kSectors + 1, 0.0), expected(kRings * kSectors + 1, 0.0);
  for (int k = 0; k < draws; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const BsdfSample sample =
        bsdf.sample(view, sampling::unit_double(2 * key), sampling::unit_double(2 * key + 1));
    std::size_t cell = kRings * kSectors;
    if (sample.weight > 0.0) {
      const math::Vec3 h = math::normalized(out + sample.incoming);
      const double x = h.x / (h.z * width_x), y = h.y / (h.z * width_y), r = std::hypot(x, y);
      const int ring = std::min(kRings - 1, static_cast<int>(kRings * std::asinh(r) / highest));
      const int sector = std::min(
          kSectors - 1, static_cast<int>(kSectors * (std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5)));
      cell = static_cast<std::size_t>(ring * kSectors + sector);
    }
    counted[cell] += 1.0;
  }
  double whole = 0.0;
  for (int ring = 0; ring < kRings * kFine; ++ring)
    for (int sector = 0; sector < kSectors * kFine; ++sector) {
      const double t = highest * (ring + 0.5) / (kRings * kFine), r = std::sinh(t);
      const double azimuth = 2.0 * std::numbers::pi * ((sector + 0.5) / (kSectors * kFine) - 0.5);
      const math::Vec3 h =
          math::normalized({r * std::cos(azimuth) * width_x, r * std::sin(azimuth) * width_y, 1.0});
      BsdfEvent event = view;
      event.incoming = math::normalized(2.0 * math::dot(out, h) * h - out);
      if (!(math::dot(out, h) > 0.0) || !(event.incoming.z > 0.0)) continue;
      const double area = width_x * width_y * r * std::cosh(t) * highest * 2.0 * std::numbers::pi /
                          (kRings * kSectors * kFine * kFine);  // of slopes
      const double share = bsdf.pdf(event) * 4.0 * math::dot(out, h) * h.z * h.z * h.z * area;
      expected[static_cast<std::size_t>(ring / kFine * kSectors + sector / kFine)] += share * draws;
      whole += share;
    }
  expected.back() = std::max(0.0, 1.0 - whole) * draws;
  // Slivers of cells above the horizon may lie between the points of the sum: pooled with others, they may be hit.
  for (double& count : expected) count = std::max(count, 1e-9);
  return math::chi_square_test(counted, expected);
}

double directions_against_density(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int draws,
                                  std::uint64_t seed) {
  constexpr int kRows = 8, kColumns = 16;
  // Points as close as the lobe is narrow, at the pole too.
  const double spread = side == Side::transmitted ? bsdf.passed_spread() : 0.0;
  const int fine = spread > 0.0 && spread < 0.3 ? 160 : 24;
  BsdfEvent event = view_of(outgoing, side);
  const double up = side == Side::reflected ? 1.0 : -1.0;
  std::vector<double> counted(kRows * kColumns + 1, 0.0), expected(kRows * kColumns + 1, 0.0);
  for (int k = 0; k < draws; ++k) {
    const BsdfSample sample = bsdf.sample(event, sampling::unit_double(sampling::hash(seed, k, 0)),
                                          sampling::unit_double(sampling::hash(seed, k, 1)));
    std::size_t cell = kRows * kColumns;
    if (sample.weight > 0.0) {
      const double turn = std::atan2(sample.incoming.y, sample.incoming.x) / (2.0 * pi) + 0.5;
      const int row = std::clamp(static_cast<int>(up * sample.incoming.z * kRows), 0, kRows - 1),
                column = std::min(kColumns - 1, static_cast<int>(turn * kColumns));
      cell = static_cast<std::size_t>(row * kColumns + column);
    }
    counted[cell] += 1.0;
  }
  double whole = 0.0;
  for (int row = 0; row < kRows * fine; ++row)
    for (int column = 0; column < kColumns * fine; ++column) {
      const double z = (row + 0.5) / (kRows * fine), r = std::sqrt(1.0 - z * z);
      const double azimuth = 2.0 * pi * ((column + 0.5) / (kColumns * fine) - 0.5);
      event.incoming = {r * std::cos(azimuth), r * std::sin(azimuth), up * z};
      const double share = bsdf.pdf(event) * 2.0 * pi / (kRows * kColumns * fine * fine);
      expected[static_cast<std::size_t>(row / fine * kColumns + column / fine)] += share * draws;
      whole += share;
    }
  expected.back() = std::max(1e-9, (1.0 - whole) * draws);
  return math::chi_square_test(counted, expected);
}

double worst_round_trip(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int across) {
  BsdfEvent event = view_of(outgoing, side);
  double worst = 0.0;
  for (int k = 0; k < across * across; ++k) {
    const BsdfSample sample = bsdf.sample(event, (k % across + 0.5) / across, (k / across + 0.5) / across);
    if (!(sample.weight > 0.0)) continue;
    event.incoming = sample.incoming;
    const UnitSquarePoint u = bsdf.invert(event);
    worst = std::max(worst, math::length(bsdf.sample(event, u.u1, u.u2).incoming - sample.incoming));
  }
  return worst;
}

double worst_reciprocity(const Bsdf& bsdf, math::Vec3 outgoing, Side side, int across) {
  double worst = 0.0;
  // Back out of a medium comes what its side of the boundary sends on, n^2 of which goes in.
  const bool into = side == Side::transmitted && bsdf.passage() == Passage::into;
  const std::shared_ptr<const Bsdf> behind = into ? bsdf.behind() : nullptr;
  const Bsdf& other = behind != nullptr ? *behind : bsdf;
  const double widens = behind != nullptr ? bsdf.bending_index() * bsdf.bending_index() : 1.0;
  for (int k = 0; k < across * across; ++k) {
    BsdfEvent event = view_of(outgoing, side);
    const BsdfSample sample = bsdf.sample(event, (k % across + 0.5) / across, (k / across + 0.5) / across);
    if (!(sample.weight > 0.0)) continue;
    event.incoming = sample.incoming;
    const double there = brdf_at(bsdf, event);
    std::swap(event.outgoing, event.incoming);
    if (side == Side::transmitted) event.normal = -event.normal;
    const double back = widens * brdf_at(other, event), larger = std::max(there, back);
    if (larger > 0.0) worst = std::max(worst, std::abs(there - back) / larger);
  }
  return worst;
}

}  // namespace ifov::materials
