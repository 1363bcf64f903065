#include "session/surveys/gas_model_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "atmosphere/gas/term_fit.h"
#include "core/call_scope.h"
#include "core/error.h"
#include "core/format.h"
#include "io/atmosphere/gas_model_file.h"
#include "io/atmosphere/gas_spectra_file.h"
#include "io/atmosphere/gas_words.h"
#include "io/files/own_files.h"

namespace ifov::session {
namespace {

using atmosphere::GasSpectra;
using atmosphere::TermFit;

std::vector<GasSpectra> read(const GasModelQuestion& question) {
  if (question.spectra.empty()) throw InputError("there are no spectra to make a gas model of");
  std::vector<GasSpectra> all;
  for (const GasModelQuestion::Spectra& asked : question.spectra) {
    const std::optional<atmosphere::Gas> gas = io::gas_of(asked.gas);
    if (!gas) throw InputError(io::unknown_gas(asked.gas));
    for (const GasSpectra& other : all)
      if (other.gas.gas == *gas) throw InputError(format("the gas {} is there twice", asked.gas));
    if (!(asked.self_broadening >= 0.1 && asked.self_broadening <= 20.0))
      throw InputError(format("self-broadening of {} is {:g} times that by air; expected 0.1 to 20",
                              asked.gas, asked.self_broadening));
    if (asked.depth_error && !(*asked.depth_error >= 0.0 && *asked.depth_error <= 1.0))
      throw InputError(format("the depth of {} is said to be off by {:g} of itself; expected 0 to 1",
                              asked.gas, *asked.depth_error));
    GasSpectra spectra = io::read_gas_spectra(asked.file);
    spectra.gas = {*gas, asked.self_broadening, asked.holds_continuum, asked.depth_error};
    if (!all.empty()) {
      const GasSpectra& first = all.front();
      const std::string pair =
          format("{} and {}", question.spectra.front().file.string(), asked.file.string());
      if (spectra.wavenumber_cm1 != first.wavenumber_cm1)
        throw InputError(format("{} have other wavenumbers: gases of one model share them", pair));
      if (spectra.states.pressure_hPa() != first.states.pressure_hPa() ||
          spectra.states.temperature_K() != first.states.temperature_K())
        throw InputError(
            format("{} have other pressures or temperatures: gases of one model share them", pair));
    }
    all.push_back(std::move(spectra));
  }
  return all;
}

/// Where the bins begin and how many there are.
void lay_bins(const GasModelQuestion& question, const std::vector<double>& wavenumber_cm1, TermFit& fit) {
  const double step = question.step_cm1, low = wavenumber_cm1.front(), high = wavenumber_cm1.back();
  constexpr double kRounding = 1e-9;
  fit.step_cm1 = step;
  fit.first_cm1 = question.first_cm1.value_or(step * std::ceil(low / step - kRounding));
  const double last = question.last_cm1.value_or(step * std::floor(high / step + kRounding));
  const double bins = std::floor((last - fit.first_cm1) / step + kRounding);
  if (!(fit.first_cm1 >= low - kRounding * low && last <= high + kRounding * high))
    throw InputError(
        format("bins from {:g} to {:g} cm-1 were asked for; the spectra reach from {:g} to {:g} cm-1",
               fit.first_cm1, last, low, high));
  if (!(bins >= 1.0))
    throw InputError(
        format("no bin of {:g} cm-1 lies between {:g} and {:g} cm-1", step, fit.first_cm1, last));
  fit.bins = static_cast<std::size_t>(bins);
  constexpr std::ptrdiff_t kFewest = 20;
  for (std::size_t b = 0; b < fit.bins; ++b) {
    const double from = fit.first_cm1 + step * static_cast<double>(b), to = from + step;
    const auto at = [&](double edge_cm1) {
      return std::lower_bound(wavenumber_cm1.begin(), wavenumber_cm1.end(), edge_cm1 * (1.0 - kRounding));
    };
    if (const auto points = at(to) - at(from); points < kFewest)
      throw InputError(format(
          "the spectra have {} points in the bin from {:.10g} to {:.10g} cm-1; expected {} at least, and some "
          "across the narrowest line",
          points, from, to, kFewest));
  }
}

/// Between states cross sections are interpolated, which no comparison with the spectra shows.
std::vector<std::string> warnings_of(const atmosphere::StateGrid& states) {
  constexpr double kStep = 3.5, kStep_K = 40.0, kLowest_hPa = 3.0, kHighest_hPa = 950.0;
  constexpr const char* kSo = "which the errors of the terms do not hold";
  std::vector<std::string> warnings;
  const std::vector<double>&p = states.pressure_hPa(), &t = states.temperature_K();
  for (std::size_t k = 1; k < p.size(); ++k)
    if (p[k] > kStep * p[k - 1] && p[k] > kLowest_hPa)
      warnings.push_back(
          format("from {:g} to {:g} hPa cross sections are interpolated, {}; take pressures a factor of 3 "
                 "apart at most",
                 p[k - 1], p[k], kSo));
  for (std::size_t k = 1; k < t.size(); ++k)
    if (t[k] - t[k - 1] > kStep_K)
      warnings.push_back(format(
          "from {:g} to {:g} K cross sections are interpolated, {}; take temperatures 30 K apart at most",
          t[k - 1], t[k], kSo));
  if (p.front() > kLowest_hPa || p.back() < kHighest_hPa)
    warnings.push_back(
        format("the spectra are of {:g} to {:g} hPa; air beyond that has the nearest of these, {}", p.front(),
               p.back(), kSo));
  return warnings;
}

/// Before the work begins.
void check_written(const GasModelQuestion& question, const std::filesystem::path& to) {
  std::error_code none;
  const std::filesystem::path folder = to.has_parent_path() ? to.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, none))
    throw SystemError(format("{} cannot be written: there is no folder {}", to.string(), folder.string()));
  for (const GasModelQuestion::Spectra& spectra : question.spectra)
    if (std::filesystem::equivalent(to, spectra.file, none))
      throw InputError(format("{} is to be written, and holds the spectra of {}; expected another file",
                              to.string(), spectra.gas));
}

void check(const GasModelQuestion& question) {
  if (!(question.step_cm1 >= 0.001 && question.step_cm1 <= 20.0))
    throw InputError(format("bins of {:g} cm-1 were asked for; expected 0.001 to 20", question.step_cm1));
  if (question.most_terms < 1 || question.most_terms > TermFit::kMostTerms)
    throw InputError(
        format("{} terms were asked for; expected 1 to {}", question.most_terms, TermFit::kMostTerms));
  if (!(question.error >= 1e-6 && question.error <= 0.1))
    throw InputError(format("an error of {:g} was asked for; expected 1e-06 to 0.1", question.error));
  if (question.source.find_first_of("\r\n") != std::string::npos)
    throw InputError("the source of a gas model is one line");
}

}  // namespace

GasModelOutcome make_gas_model(const GasModelQuestion& question, const std::filesystem::path& to) {
  check(question);
  check_written(question, to);
  const std::vector<GasSpectra> spectra = read(question);
  TermFit fit;
  lay_bins(question, spectra.front().wavenumber_cm1, fit);
  fit.most_terms = question.most_terms;
  fit.error = question.error;
  fit.threads = question.threads;
  const auto start = std::chrono::steady_clock::now();
  fit.progress = [&](std::size_t done) {
    stop_if_cancelled();
    if (question.progress == nullptr) return;
    Progress progress;
    progress.pixels_done = static_cast<std::int64_t>(done);
    progress.pixels_total = static_cast<std::int64_t>(fit.bins);
    progress.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    question.progress->report(progress);
  };
  atmosphere::FittedTerms made = atmosphere::fit_terms(spectra, fit);
  made.table.source = question.source;
  io::write_new_file(to, io::gas_model_text(made.table));
  return {.bins = made.table.bins.size(),
          .first_cm1 = made.table.first_cm1,
          .last_cm1 = made.table.last_cm1(),
          .terms = made.errors.terms,
          .largest_error = made.errors.largest,
          .largest_error_at_cm1 = made.errors.largest_at_cm1,
          .rms_error = made.errors.rms,
          .between_states = made.errors.between,
          .mean_error = made.errors.mean,
          .random_overlap = made.errors.overlap,
          .missed = made.errors.missed,
          .warnings = warnings_of(spectra.front().states)};
}

}  // namespace ifov::session
