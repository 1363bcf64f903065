#include "materials/bsdf/bsdf_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"

namespace ifov::materials {

using std::numbers::pi;

namespace {

constexpr double kRound = 2.0 * pi, kMostGap = 0.5 * pi + 1e-9;

double degrees(double rad) { return rad * 180.0 / pi; }

/// As bracket(), of azimuths that go round: the last is followed by the first.
struct RoundBracket {
  std::size_t below, above;
  double share;
};
RoundBracket round_bracket(const std::vector<double>& rising, double azimuth) {
  const double within = azimuth - kRound * std::floor(azimuth / kRound);
  const auto next =
      static_cast<std::size_t>(std::upper_bound(rising.begin(), rising.end(), within) - rising.begin());
  const std::size_t last = rising.size() - 1, below = next == 0 ? last : next - 1,
                    above = next > last ? 0 : next;
  const double start = next == 0 ? rising[last] - kRound : rising[below];
  const double end = next > last ? rising[0] + kRound : rising[above];
  return {below, above, (within - start) / (end - start)};
}

/// Linear in zenith angles and azimuths, as far as the table goes.
double between(const MeasuredBrdf& m, BsdfTable::Direction in, BsdfTable::Direction out, std::size_t azimuth,
               std::size_t wavelength) {
  const Bracket i = bracket(m.zenith_in_rad, in.zenith_rad), o = bracket(m.zenith_out_rad, out.zenith_rad);
  RoundBracket p{0, 0, 0.0}, q{azimuth, azimuth, 0.0};
  if (!m.is_isotropic()) {
    p = round_bracket(m.azimuth_in_rad, in.azimuth_rad);
    q = round_bracket(m.azimuth_out_rad, out.azimuth_rad);
  }
  double sum = 0.0;
  for (std::size_t corner = 0; corner < 16; ++corner) {
    const std::size_t a = corner & 1, b = corner >> 1 & 1, c = corner >> 2 & 1, d = corner >> 3;
    const double weight = (a ? i.share : 1.0 - i.share) * (b ? o.share : 1.0 - o.share) *
                          (c ? p.share : 1.0 - p.share) * (d ? q.share : 1.0 - q.share);
    if (weight > 0.0)
      sum +=
          weight * m.at(i.below + a, c ? p.above : p.below, o.below + b, d ? q.above : q.below, wavelength);
  }
  return sum;
}

bool is_covered(const std::vector<double>& rising, double value) {
  return value >= rising.front() - 1e-12 && value <= rising.back() + 1e-12;
}

void check_round(const std::vector<double>& azimuths, std::string_view what) {
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    const bool last = k + 1 == azimuths.size();
    const double next = last ? azimuths[0] + kRound : azimuths[k + 1];
    if (next - azimuths[k] > kMostGap)
      throw InputError(format(
          "azimuths of the {} go round and leave out no more than 90 deg; there is none between {:g} and {:g} deg",
          what, degrees(azimuths[k]), degrees(next)));
  }
}

/// Azimuths of the view counterclockwise as seen from its own side, which is the other one.
MeasuredBrdf seen_from_the_view(const MeasuredBrdf& m) {
  MeasuredBrdf turned = m;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < m.azimuth_out_rad.size(); ++k)
    order.emplace_back(m.azimuth_out_rad[k] > 0.0 ? kRound - m.azimuth_out_rad[k] : 0.0, k);
  std::sort(order.begin(), order.end());
  turned.brdf.clear();
  for (std::size_t k = 0; k < order.size(); ++k) turned.azimuth_out_rad[k] = order[k].first;
  for (std::size_t i = 0; i < m.zenith_in_rad.size(); ++i)
    for (std::size_t p = 0; p < m.azimuth_in_rad.size(); ++p)
      for (std::size_t o = 0; o < m.zenith_out_rad.size(); ++o)
        for (const auto& azimuth : order)
          for (std::size_t n = 0; n < m.wavelength_um.size(); ++n)
            turned.brdf.push_back(m.at(i, p, o, azimuth.second, n));
  return turned;
}

std::vector<double> united(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kSame = 1e-9;
  std::vector<double> all;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  all.erase(std::unique(all.begin(), all.end(), [](double x, double y) { return y - x < kSame; }), all.end());
  return all;
}

}  // namespace

Bracket bracket(const std::vector<double>& rising, double value) {
  if (rising.size() == 1 || value <= rising.front()) return {0, 0.0};
  if (value >= rising.back()) return {rising.size() - 2, 1.0};
  const auto above =
      static_cast<std::size_t>(std::upper_bound(rising.begin(), rising.end(), value) - rising.begin());
  return {above - 1, (value - rising[above - 1]) / (rising[above] - rising[above - 1])};
}

BsdfTable::BsdfTable(const MeasuredBrdf& measured, bool repair, Kind kind)
    : kind_(kind), azimuth_rad_(measured.azimuth_rad), wavelength_um_(measured.wavelength_um) {
  zenith_rad_ = united(measured.zenith_in_rad, measured.zenith_out_rad);
  const bool turns = !measured.is_isotropic() && kind == Kind::transmitted;
  const MeasuredBrdf* source = &measured;
  MeasuredBrdf turned;
  if (turns) turned = seen_from_the_view(measured), source = &turned;
  if (!measured.is_isotropic()) {
    check_round(measured.azimuth_in_rad, "light");
    check_round(measured.azimuth_out_rad, "view");
    turn_rad_ = united(source->azimuth_in_rad, source->azimuth_out_rad);
    azimuth_rad_ = {0.0};
  }
  const double directions = static_cast<double>(direction_count());
  if (directions * (directions + 1) / 2.0 * static_cast<double>(azimuth_rad_.size()) >
      static_cast<double>(kMostRows))
    throw InputError(format(
        "{} zenith angles{} of light and view together{} make more than {} pairs of directions; thin them",
        zenith_rad_.size(), is_isotropic() ? "" : format(" and {} azimuths", turn_rad_.size()),
        is_isotropic() ? format(" and {} azimuths", azimuth_rad_.size()) : "", kMostRows));
  brdf_.resize(row_count() * wavelength_um_.size());
  make_reciprocal(*source, repair);
  make_passive(repair);
}

BsdfTable::Direction BsdfTable::direction(std::size_t index) const {
  if (is_isotropic()) return {zenith_rad_[index], 0.0};
  return {zenith_rad_[index / turn_rad_.size()], turn_rad_[index % turn_rad_.size()]};
}

/// As its file has it: seen from the side of the light.
std::string BsdfTable::named(Direction direction) const {
  return is_isotropic() ? format("{:g} deg", degrees(direction.zenith_rad))
                        : format("{:g} deg in azimuth {:g} deg", degrees(direction.zenith_rad),
                                 degrees(direction.azimuth_rad));
}

void BsdfTable::make_reciprocal(const MeasuredBrdf& m, bool repair) {
  const double floor = 0.01 * *std::max_element(m.brdf.begin(), m.brdf.end());
  struct {
    double asymmetry = 0.0;
    std::size_t a = 0, b = 0;
    double there = 0.0, back = 0.0;
    std::size_t azimuth = 0, wavelength = 0;
  } worst;
  for (std::size_t i = 0; i < direction_count(); ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (std::size_t k = 0; k < azimuth_rad_.size(); ++k)
        for (std::size_t n = 0; n < wavelength_um_.size(); ++n) {
          const Direction a = direction(i), b = direction(j);
          const double there = between(m, a, b, k, n), back = between(m, b, a, k, n);
          const bool is_there = is_covered(m.zenith_in_rad, a.zenith_rad) &&
                                is_covered(m.zenith_out_rad, b.zenith_rad),
                     is_back = is_covered(m.zenith_in_rad, b.zenith_rad) &&
                               is_covered(m.zenith_out_rad, a.zenith_rad);
          // Where one of them was not measured the other stands for both.
          const double mean = is_there == is_back ? 0.5 * (there + back) : is_there ? there : back;
          brdf_[row(i, j, k) * wavelength_um_.size() + n] = mean;
          if (!(is_there && is_back)) continue;
          const double asymmetry = std::abs(there - back) / std::max(mean, floor);
          if (asymmetry > worst.asymmetry) worst = {asymmetry, i, j, there, back, k, n};
        }
  if (worst.asymmetry <= kMostAsymmetry) return;
  Direction view = direction(worst.b);
  if (kind_ == Kind::transmitted && view.azimuth_rad > 0.0) view.azimuth_rad = kRound - view.azimuth_rad;
  const std::string what =
      format("at {:g} um light from {} seen from {}{} has a {} of {:.4g} /sr, and with both exchanged {:.4g}",
             wavelength_um_[worst.wavelength], named(direction(worst.a)), named(view),
             is_isotropic() ? format(", azimuth {:g} deg,", degrees(azimuth_rad_[worst.azimuth])) : "",
             kind_ == Kind::reflected ? "BRDF" : "BTDF", worst.there, worst.back);
  if (!repair)
    throw InputError(format("not reciprocal by {:.3g} %: {}; \"repair\": true takes the mean",
                            100.0 * worst.asymmetry, what));
  changes_.push_back(format("the mean of both directions is taken, which differ by up to {:.3g} %: {}",
                            100.0 * worst.asymmetry, what));
}

std::array<BsdfTable::Share, 4> BsdfTable::shares(Direction direction) const {
  const Bracket z = bracket(zenith_rad_, direction.zenith_rad);
  const std::size_t above = std::min(z.below + 1, zenith_rad_.size() - 1);
  if (is_isotropic()) return {{{z.below, 1.0 - z.share}, {above, z.share}, {0, 0.0}, {0, 0.0}}};
  const RoundBracket p = round_bracket(turn_rad_, direction.azimuth_rad);
  const std::size_t turns = turn_rad_.size();
  return {{{z.below * turns + p.below, (1.0 - z.share) * (1.0 - p.share)},
           {z.below * turns + p.above, (1.0 - z.share) * p.share},
           {above * turns + p.below, z.share * (1.0 - p.share)},
           {above * turns + p.above, z.share * p.share}}};
}

BsdfTable::Corners BsdfTable::corners(Direction in, Direction out, double between_rad) const {
  const std::array<Share, 4> from = shares(in), to = shares(out);
  const Bracket across = is_isotropic() ? bracket(azimuth_rad_, between_rad) : Bracket{};
  Corners all;
  for (const Share& a : from)
    for (const Share& b : to)
      for (std::size_t c = 0; c < 2; ++c) {
        const double weight = a.weight * b.weight * (c ? across.share : 1.0 - across.share);
        if (!(weight > 0.0)) continue;
        all.row[all.count] = row(a.direction, b.direction, across.below + c);
        all.weight[all.count++] = weight;
      }
  return all;
}

std::vector<double> BsdfTable::directional_hemispherical(std::size_t index) const {
  constexpr int kZeniths = 180;
  const int azimuths = is_isotropic() ? 90 : 120;
  const double round = is_isotropic() ? pi : kRound;
  // Rows first: many directions share them.
  std::vector<double> of_row(row_count(), 0.0);
  const Direction towards = direction(index);
  for (int i = 0; i < kZeniths; ++i) {
    const double theta = 0.5 * pi * (i + 0.5) / kZeniths;
    const double ring = std::sin(theta) * std::cos(theta) * 0.5 * pi / kZeniths * kRound / azimuths;
    for (int j = 0; j < azimuths; ++j) {
      const double azimuth = round * (j + 0.5) / azimuths;
      const Corners at = corners({theta, azimuth}, towards, azimuth);
      for (std::size_t k = 0; k < at.count; ++k) of_row[at.row[k]] += ring * at.weight[k];
    }
  }
  const std::size_t count = wavelength_um_.size();
  std::vector<double> sum(count, 0.0);
  for (std::size_t r = 0; r < of_row.size(); ++r)
    if (of_row[r] > 0.0)
      for (std::size_t n = 0; n < count; ++n) sum[n] += of_row[r] * brdf_[r * count + n];
  return sum;
}

double BsdfTable::narrowest_peak_sr() const {
  constexpr double kLeastPart = 0.02;    // of what leaves
  constexpr double kSteepest_rad = 0.9;  // slanting light makes any lobe narrow
  constexpr std::size_t kMostAsked = 48;
  constexpr int kZeniths = 180, kAzimuths = 120;
  const std::size_t count = wavelength_um_.size();
  const auto largest = std::max_element(brdf_.begin(), brdf_.end());
  const auto n = static_cast<std::size_t>(largest - brdf_.begin()) % count;
  double narrowest = kRound;
  const std::size_t step = std::max<std::size_t>(1, direction_count() / kMostAsked);
  for (std::size_t d = 0; d < direction_count(); d += step) {
    if (direction(d).zenith_rad > kSteepest_rad) continue;
    const double mean = directional_hemispherical(d)[n] / pi;
    if (!(mean > 0.0)) continue;
    double peak = 0.0, held = 0.0;
    for (int i = 0; i < kZeniths; ++i) {
      const double theta = 0.5 * pi * (i + 0.5) / kZeniths;
      const double ring = std::sin(theta) * std::cos(theta) * 0.5 * pi / kZeniths * kRound / kAzimuths;
      for (int j = 0; j < kAzimuths; ++j) {
        const double azimuth = kRound * (j + 0.5) / kAzimuths;
        const Corners at = corners({theta, azimuth}, direction(d), azimuth < pi ? azimuth : kRound - azimuth);
        double f = 0.0;
        for (std::size_t k = 0; k < at.count; ++k) f += at.weight[k] * brdf_[at.row[k] * count + n];
        const double more = f - 2.0 * mean;
        if (more <= 0.0) continue;
        peak = std::max(peak, more);
        held += ring * more;
      }
    }
    if (held > kLeastPart * pi * mean) narrowest = std::min(narrowest, held / peak);
  }
  return narrowest;
}

std::vector<std::vector<double>> BsdfTable::all_hemispherical() const {
  std::vector<std::vector<double>> all;
  for (std::size_t k = 0; k < direction_count(); ++k) all.push_back(directional_hemispherical(k));
  return all;
}

void BsdfTable::scale(std::size_t wavelength, double factor) {
  for (std::size_t r = 0; r < row_count(); ++r) brdf_[r * wavelength_um_.size() + wavelength] *= factor;
}

void BsdfTable::make_passive(bool repair) {
  const std::size_t count = wavelength_um_.size();
  std::vector<double> most(count, 0.0);
  std::vector<std::size_t> where(count, 0);
  for (std::size_t d = 0; d < direction_count(); ++d) {
    const std::vector<double> whole = directional_hemispherical(d);
    for (std::size_t n = 0; n < count; ++n)
      if (whole[n] > most[n]) {
        most[n] = whole[n];
        where[n] = d;
      }
  }
  const auto n = static_cast<std::size_t>(std::max_element(most.begin(), most.end()) - most.begin());
  if (most[n] <= kMostReflectance) return;
  const bool back = kind_ == Kind::reflected;
  const std::string what =
      format("at {:g} um it {} {:.4g} times what comes {} from the normal", wavelength_um_[n],
             back ? "sends back" : "lets through", most[n], named(direction(where[n])));
  if (!repair) throw InputError(format("{}; \"repair\": true scales such wavelengths down", what));
  std::size_t scaled = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (most[k] <= kMostReflectance) continue;
    ++scaled;
    scale(k, 1.0 / most[k]);
  }
  changes_.push_back(format("{} of {} wavelengths are scaled down until no more {} than arrives: {}", scaled,
                            count, back ? "comes back" : "goes through", what));
}

void BsdfTable::limit_sum(BsdfTable& reflected, BsdfTable& transmitted, bool repair) {
  const std::vector<double>& um = reflected.wavelength_um_;
  const auto lacks = [](const std::vector<double>& all, const std::vector<double>& of) {
    for (const double at : of)
      if (std::find(all.begin(), all.end(), at) == all.end())
        throw InputError(format(
            "what is reflected and what is transmitted are told at unlike wavelengths: {:g} um is of one alone",
            at));
  };
  lacks(um, transmitted.wavelength_um_);
  lacks(transmitted.wavelength_um_, um);
  // Linear in the direction between those of either table: the largest sum is at one of these.
  struct Whole {
    const BsdfTable& table;
    std::vector<std::vector<double>> at;
    double towards(Direction direction, std::size_t wavelength) const {
      double sum = 0.0;
      for (const Share& share : table.shares(direction))
        sum += share.weight * at[share.direction][wavelength];
      return sum;
    }
  };
  const Whole back{reflected, reflected.all_hemispherical()},
      through{transmitted, transmitted.all_hemispherical()};
  const std::vector<double> zeniths = united(reflected.zenith_rad_, transmitted.zenith_rad_);
  std::vector<double> turns = united(reflected.turn_rad_, transmitted.turn_rad_);
  if (turns.empty()) turns.push_back(0.0);
  std::size_t scaled = 0, worst = 0;
  double worst_sum = 0.0, worst_zenith = 0.0;
  std::vector<double> most(um.size(), 0.0);
  for (std::size_t n = 0; n < um.size(); ++n)
    for (const double zenith : zeniths)
      for (const double turn : turns) {
        const double sum = back.towards({zenith, turn}, n) + through.towards({zenith, turn}, n);
        most[n] = std::max(most[n], sum);
        if (sum > worst_sum) worst_sum = sum, worst_zenith = zenith, worst = n;
      }
  if (worst_sum <= kMostReflectance) return;
  const std::string what =
      format("at {:g} um it sends back and lets through {:.4g} times what comes {:g} deg from the normal",
             um[worst], worst_sum, degrees(worst_zenith));
  if (!repair) throw InputError(format("{}; \"repair\": true scales such wavelengths down", what));
  for (std::size_t n = 0; n < um.size(); ++n) {
    if (most[n] <= kMostReflectance) continue;
    ++scaled;
    reflected.scale(n, 1.0 / most[n]);
    transmitted.scale(n, 1.0 / most[n]);
  }
  reflected.changes_.push_back(format(
      "{} of {} wavelengths are scaled down until no more leaves than arrives: {}", scaled, um.size(), what));
}

}  // namespace ifov::materials
