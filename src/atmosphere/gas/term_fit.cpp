#include "atmosphere/gas/term_fit.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "atmosphere/gas/fit_paths.h"
#include "atmosphere/gas/term_sets.h"
#include "core/parallel.h"

namespace ifov::atmosphere {
namespace {

/// By how much longer than vertical the paths are: that terms are made by, of the whole air and of its other sections; and judged.
constexpr std::array kMadeWhole{0.002, 0.02, 0.15, 0.5, 1.0, 2.0, 4.0, 8.0, 30.0};
constexpr std::array kMadeSection{0.5, 1.5, 4.0};
constexpr std::array kJudged{1.0, 1.5, 3.0, 6.0};
constexpr std::size_t kSections = FitPaths::kSections.size();
constexpr std::size_t kWidth = kMadeWhole.size() + (kSections - 1) * kMadeSection.size();
constexpr std::array<std::size_t, 15> kCounts{1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64};
constexpr double kAbsorbsNothing = 1e-6;

using Depths = std::array<double, kSections>;
/// Mean transmittances: of all gases and each by itself, by atmosphere, section and length.
using Transmittances = std::vector<double>;

/// [gas][atmosphere], the U.S. standard atmosphere first.
using Paths = std::vector<std::vector<FitPaths>>;

/// The same paths with a part of the states.
struct FewerStates {
  Paths paths;
  std::vector<std::size_t> state;  // of the whole grid, by that of the smaller one
};
/// Two ways each to leave out every second pressure, and every second temperature; none where there are fewer than three.
struct Thinned {
  std::vector<FewerStates> pressures, temperatures;
};

class BinFit {
 public:
  BinFit(std::span<const GasSpectra> spectra, const Paths& paths, BinPoints points)
      : spectra_(spectra), paths_(paths), points_(std::move(points)), right_(size(), 0.0) {
    std::vector<Depths> depth;
    for (std::size_t i = 0; i < points_.share.size(); ++i)
      for (std::size_t a = 0; a < atmospheres(); ++a) {
        depths([&](std::size_t g, std::size_t state) { return log_k(g, state, i); }, paths_, a, depth);
        add(depth, points_.share[i], a, right_);
        if (a == 0) describe(depth);
      }
  }

  bool absorbs() const { return *std::min_element(right_.begin(), right_.end()) < 1.0 - kAbsorbsNothing; }

  TermBin with(std::size_t count) const {
    const std::size_t width = features_.size() / points_.share.size();
    const std::vector<std::size_t> set = term_sets(points_.share, features_, width, count);
    TermBin bin;
    bin.weight.assign(1 + *std::max_element(set.begin(), set.end()), 0.0);
    for (std::size_t i = 0; i < set.size(); ++i) bin.weight[set[i]] += points_.share[i];
    bin.log_k.resize(spectra_.size());
    for (std::size_t g = 0; g < spectra_.size(); ++g)
      for (std::size_t state = 0; state < spectra_[g].states.states(); ++state)
        for (const double k : set_means(g, state, set, bin.weight))
          bin.log_k[g].push_back(log_cross_section(k));
    return bin;
  }

  /// What terms transmit less what the spectra do.
  std::vector<double> errors(const TermBin& bin) const {
    Transmittances found(size(), 0.0);
    std::vector<Depths> depth;
    for (std::size_t t = 0; t < bin.terms(); ++t)
      for (std::size_t a = 0; a < atmospheres(); ++a) {
        depths([&](std::size_t g,
                   std::size_t state) { return static_cast<double>(bin.log_k[g][state * bin.terms() + t]); },
               paths_, a, depth);
        add(depth, bin.weight[t], a, found);
      }
    for (std::size_t k = 0; k < found.size(); ++k) found[k] -= right_[k];
    return found;
  }

  /// What interpolation of cross sections between states may make of transmittances.
  std::vector<double> between(const Thinned& thinned) const {
    std::vector<double> all(size(), 0.0);
    for (const std::vector<FewerStates>* ways : {&thinned.pressures, &thinned.temperatures}) {
      std::vector<double> most(size(), 0.0);
      for (const FewerStates& fewer : *ways) {
        const Transmittances found = with(fewer);
        for (std::size_t k = 0; k < most.size(); ++k)
          most[k] = std::max(most[k], std::abs(found[k] - right_[k]));
      }
      // Steps twice as wide are off by four times as much, which is three times as much more.
      for (std::size_t k = 0; k < all.size(); ++k) all[k] += most[k] / 3.0;
    }
    return all;
  }

  /// Straight through the whole U.S. standard atmosphere: product of what the gases transmit less what they do together.
  double overlap() const {
    if (spectra_.size() < 2) return 0.0;
    double product = 1.0;
    for (std::size_t g = 0; g < spectra_.size(); ++g)
      product *= right_[(g + 1) * atmospheres() * kSections * kJudged.size()];
    return product - right_[0];
  }

 private:
  std::size_t atmospheres() const { return paths_.front().size(); }
  /// All gases, and each of several.
  std::size_t mixtures() const { return spectra_.size() > 1 ? 1 + spectra_.size() : 1; }
  std::size_t size() const { return mixtures() * atmospheres() * kSections * kJudged.size(); }
  double log_k(std::size_t gas, std::size_t state, std::size_t point) const {
    return static_cast<double>(spectra_[gas].log_k[state][points_.first + point]);
  }

  /// Of each mixture.
  Transmittances with(const FewerStates& fewer) const {
    Transmittances found(size(), 0.0);
    std::vector<Depths> depth;
    for (std::size_t i = 0; i < points_.share.size(); ++i)
      for (std::size_t a = 0; a < atmospheres(); ++a) {
        depths([&](std::size_t g, std::size_t state) { return log_k(g, fewer.state[state], i); }, fewer.paths,
               a, depth);
        add(depth, points_.share[i], a, found);
      }
    return found;
  }
  template <class LogK>
  void depths(const LogK& log_k_of, const Paths& paths, std::size_t atmosphere,
              std::vector<Depths>& depth) const {
    depth.assign(mixtures(), Depths{});
    for (std::size_t g = 0; g < spectra_.size(); ++g) {
      const Depths own = paths[g][atmosphere].depths([&](std::size_t state) { return log_k_of(g, state); });
      for (std::size_t s = 0; s < kSections; ++s) depth[0][s] += own[s];
      if (mixtures() > 1) depth[g + 1] = own;
    }
  }

  void add(const std::vector<Depths>& depth, double share, std::size_t atmosphere, Transmittances& to) const {
    for (std::size_t m = 0; m < depth.size(); ++m) {
      std::size_t at = (m * atmospheres() + atmosphere) * kSections * kJudged.size();
      for (const double d : depth[m])
        for (const double length : kJudged) to[at++] += share * std::exp(-length * d);
    }
  }

  void describe(const std::vector<Depths>& depth) {
    for (const Depths& d : depth) {
      for (const double length : kMadeWhole) features_.push_back(std::exp(-length * d[0]));
      for (std::size_t s = 1; s < kSections; ++s)
        for (const double length : kMadeSection) features_.push_back(std::exp(-length * d[s]));
    }
  }

  std::vector<double> set_means(std::size_t gas, std::size_t state, const std::vector<std::size_t>& set,
                                const std::vector<double>& weight) const {
    std::vector<double> k(set.size()), mean(weight.size(), 0.0), through(weight.size(), 0.0);
    for (std::size_t i = 0; i < set.size(); ++i) {
      k[i] = std::exp(log_k(gas, state, i));
      mean[set[i]] += points_.share[i] / weight[set[i]] * k[i];
    }
    const double most_cm2 = 2.0 * paths_[gas].front().molecules_cm2();
    const auto amount = [&](std::size_t s) { return std::min(most_cm2, 1.0 / mean[s]); };
    for (std::size_t i = 0; i < set.size(); ++i)
      through[set[i]] += points_.share[i] / weight[set[i]] * std::expm1(-k[i] * amount(set[i]));
    for (std::size_t s = 0; s < mean.size(); ++s) mean[s] = -std::log1p(through[s]) / amount(s);
    return mean;
  }

  std::span<const GasSpectra> spectra_;
  const Paths& paths_;
  BinPoints points_;
  std::vector<double> features_;
  Transmittances right_;
};

double largest(const std::vector<double>& errors) {
  double most = 0.0;
  for (const double error : errors) most = std::max(most, std::abs(error));
  return most;
}

/// As few terms as the asked error needs; of those that miss it the best.
TermBin fitted(const BinFit& bin, const TermFit& fit, std::vector<double>& errors) {
  TermBin best;
  for (const std::size_t count : kCounts) {
    if (count > fit.most_terms) break;
    TermBin tried = bin.with(count);
    std::vector<double> off = bin.errors(tried);
    tried.error = largest(off);
    if (!best.weight.empty() && tried.error >= best.error) continue;
    best = std::move(tried);
    errors = std::move(off);
    if (best.error <= fit.error) break;
  }
  return best;
}

Paths paths_of(std::span<const GasSpectra> spectra, const StateGrid& states) {
  constexpr std::string_view kFirst = "US standard 1976";
  Paths paths(spectra.size());
  for (std::size_t g = 0; g < spectra.size(); ++g) {
    paths[g].emplace_back(kFirst, spectra[g].gas, states);
    for (const std::string& model : model_atmosphere_names())
      if (model != kFirst) paths[g].emplace_back(model, spectra[g].gas, states);
  }
  return paths;
}

/// Of a list: all; or the first, the last and of those between the even or the odd ones.
enum class Kept : std::size_t { even, odd, all };
std::vector<std::size_t> kept(std::size_t count, Kept which) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i)
    if (which == Kept::all || i == 0 || i + 1 == count || i % 2 == static_cast<std::size_t>(which))
      places.push_back(i);
  return places;
}

Thinned thinned(std::span<const GasSpectra> spectra) {
  const StateGrid& whole = spectra.front().states;
  const std::size_t pressures = whole.pressure_hPa().size(), temperatures = whole.temperature_K().size();
  Thinned all;
  const auto add = [&](const std::vector<std::size_t>& p, const std::vector<std::size_t>& t,
                       std::vector<FewerStates>& to) {
    if (p.size() == pressures && t.size() == temperatures) return;
    std::vector<double> of_p, of_t;
    for (const std::size_t i : p) of_p.push_back(whole.pressure_hPa()[i]);
    for (const std::size_t i : t) of_t.push_back(whole.temperature_K()[i]);
    FewerStates fewer{paths_of(spectra, StateGrid(of_p, of_t)), {}};
    for (const std::size_t i : p)
      for (const std::size_t k : t) fewer.state.push_back(i * temperatures + k);
    to.push_back(std::move(fewer));
  };
  for (const Kept which : {Kept::even, Kept::odd}) {
    add(kept(pressures, which), kept(temperatures, Kept::all), all.pressures);
    add(kept(pressures, Kept::all), kept(temperatures, which), all.temperatures);
  }
  return all;
}

TermFitErrors summed_up(const GasTermTable& table, const std::vector<std::vector<double>>& errors,
                        const std::vector<double>& overlap, double asked) {
  TermFitErrors all;
  std::vector<double> mean;
  double squares = 0.0, count = 0.0, absorbing = 0.0;
  const double bins = static_cast<double>(table.bins.size());
  for (std::size_t b = 0; b < table.bins.size(); ++b) {
    all.overlap += overlap[b] * overlap[b] / bins;
    const TermBin& bin = table.bins[b];
    if (bin.weight.empty()) continue;
    absorbing += 1.0;
    all.terms += static_cast<double>(bin.terms());
    const double off = largest(errors[b]);
    all.missed += off > asked ? 1 : 0;
    if (off > all.largest) all.largest = off, all.largest_at_cm1 = table.centre_cm1(b);
    mean.resize(errors[b].size());
    for (std::size_t p = 0; p < errors[b].size(); ++p) {
      mean[p] += errors[b][p] / bins;
      squares += errors[b][p] * errors[b][p];
      count += 1.0;
    }
  }
  all.rms = count > 0.0 ? std::sqrt(squares / count) : 0.0;
  all.mean = largest(mean);
  all.terms = absorbing > 0.0 ? all.terms / absorbing : 0.0;
  all.overlap = std::sqrt(all.overlap);
  return all;
}

}  // namespace

FittedTerms fit_terms(std::span<const GasSpectra> spectra, const TermFit& fit) {
  FittedTerms made;
  GasTermTable& table = made.table;
  table.first_cm1 = fit.first_cm1;
  table.step_cm1 = fit.step_cm1;
  table.states = spectra.front().states;
  for (const GasSpectra& gas : spectra) table.gases.push_back(gas.gas);
  table.bins.resize(fit.bins);
  const Paths paths = paths_of(spectra, spectra.front().states);
  const Thinned fewer = thinned(spectra);
  std::vector<std::vector<double>> errors(fit.bins);
  std::vector<double> overlap(fit.bins, 0.0), between(fit.bins, 0.0);
  std::mutex telling;
  std::size_t done = 0;
  parallel_for(static_cast<std::int64_t>(fit.bins), fit.threads, [&](std::int64_t k) {
    const std::size_t b = static_cast<std::size_t>(k);
    const BinFit bin(spectra, paths,
                     points_in(spectra.front().wavenumber_cm1, table.edge_cm1(b), table.edge_cm1(b + 1)));
    overlap[b] = bin.overlap();
    if (bin.absorbs()) {
      table.bins[b] = fitted(bin, fit, errors[b]);
      const std::vector<double> more = bin.between(fewer);
      between[b] = largest(more);
      table.bins[b].error = 0.0;
      for (std::size_t p = 0; p < more.size(); ++p)
        table.bins[b].error = std::max(table.bins[b].error, std::abs(errors[b][p]) + more[p]);
    }
    if (!fit.progress) return;
    const std::scoped_lock lock(telling);
    fit.progress(++done);
  });
  made.errors = summed_up(table, errors, overlap, fit.error);
  made.errors.between = largest(between);
  return made;
}

}  // namespace ifov::atmosphere
