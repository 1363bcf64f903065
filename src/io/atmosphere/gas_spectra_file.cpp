#include "io/atmosphere/gas_spectra_file.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "core/format.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostStates = 10000;
constexpr double kMostK_cm2 = 1e-10;
constexpr std::string_view kWavenumbers[] = {"cm-1", "cm^-1", "cm**-1", "1/cm", "cm⁻¹", "wavenumber"};

struct State {
  double pressure_hPa, temperature_K;
};

/// "1013.25 hPa 296 K"
State state_in(const TextFile& file, int number, const Field& field) {
  const std::vector<Field> words = split(field.text, ' ');
  if (words.size() == 4 && words[1].text == "hPa" && words[3].text == "K") {
    const std::optional<double> pressure = number_in(words[0].text), temperature = number_in(words[2].text);
    if (pressure && temperature && *pressure > 0.0 && *temperature > 0.0) return {*pressure, *temperature};
  }
  file.fail(number, field.column,
            format("found '{}'; expected a state such as '1013.25 hPa 296 K'", field.text));
}

std::vector<double> different(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The states of a heading as a grid, and where in it each column is.
atmosphere::StateGrid grid_of(const TextFile& file, int number, const std::vector<Field>& heading,
                              std::vector<std::size_t>& place) {
  if (heading.size() < 2 || heading.size() > kMostStates + 1)
    file.fail(
        number, 0,
        format("found {} columns; expected wavenumbers and 1 to {} states", heading.size(), kMostStates));
  const std::string first = lower_case(heading.front().text);
  if (std::none_of(std::begin(kWavenumbers), std::end(kWavenumbers),
                   [&](std::string_view word) { return first.find(word) != std::string::npos; }))
    file.fail(
        number, heading.front().column,
        format("found '{}'; expected 'cm-1': the first column holds wavenumbers", heading.front().text));
  std::vector<State> states;
  std::vector<double> pressures, temperatures;
  for (std::size_t k = 1; k < heading.size(); ++k) {
    states.push_back(state_in(file, number, heading[k]));
    pressures.push_back(states.back().pressure_hPa);
    temperatures.push_back(states.back().temperature_K);
  }
  pressures = different(std::move(pressures));
  temperatures = different(std::move(temperatures));
  std::vector<bool> taken(pressures.size() * temperatures.size(), false);
  for (std::size_t k = 0; k < states.size(); ++k) {
    const auto index = [](const std::vector<double>& values, double value) {
      return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
    };
    const std::size_t at = index(pressures, states[k].pressure_hPa) * temperatures.size() +
                           index(temperatures, states[k].temperature_K);
    if (taken[at])
      file.fail(number, heading[k + 1].column, format("the state '{}' is there twice", heading[k + 1].text));
    taken[at] = true;
    place.push_back(at);
  }
  for (std::size_t at = 0; at < taken.size(); ++at)
    if (!taken[at])
      file.fail(number, 0,
                format("{:g} hPa with {:g} K is missing; expected every pressure with every temperature",
                       pressures[at / temperatures.size()], temperatures[at % temperatures.size()]));
  return {std::move(pressures), std::move(temperatures)};
}

}  // namespace

atmosphere::GasSpectra read_gas_spectra(const std::filesystem::path& path) {
  return parse_gas_spectra(TextFile(path));
}

atmosphere::GasSpectra parse_gas_spectra(const TextFile& file) {
  atmosphere::GasSpectra spectra;
  std::vector<std::size_t> place;
  char separator = '\0';
  for (int number = 1; number <= file.line_count(); ++number) {
    const std::string_view line = file.line(number);
    if (is_blank(line) || is_comment(line)) continue;
    if (separator == '\0') {
      separator = separator_of(line);
      spectra.states = grid_of(file, number, split(line, separator), place);
      spectra.log_k.resize(spectra.states.states());
      continue;
    }
    const std::vector<Field> fields = split(line, separator);
    if (fields.size() != place.size() + 1)
      file.fail(number, 0,
                format("found {} columns; expected {} as in the heading", fields.size(), place.size() + 1));
    const std::optional<double> nu = number_in(fields[0].text);
    if (!nu || !(*nu > 0.0))
      file.fail(number, fields[0].column,
                format("found '{}'; expected a wavenumber in cm-1, above 0", fields[0].text));
    if (!spectra.wavenumber_cm1.empty() && *nu <= spectra.wavenumber_cm1.back())
      file.fail(number, fields[0].column,
                format("{:.10g} cm-1 does not rise above {:.10g} cm-1", *nu, spectra.wavenumber_cm1.back()));
    spectra.wavenumber_cm1.push_back(*nu);
    for (std::size_t k = 1; k < fields.size(); ++k) {
      const std::optional<double> value = number_in(fields[k].text);
      if (!value || *value < 0.0 || *value > kMostK_cm2)
        file.fail(number, fields[k].column,
                  format("found '{}'; expected a cross section in cm2 per molecule, 0 to {:g}",
                         fields[k].text, kMostK_cm2));
      spectra.log_k[place[k - 1]].push_back(atmosphere::log_cross_section(*value));
    }
  }
  if (separator == '\0')
    file.fail(0, 0, "found an empty file; expected a heading of states and rows of wavenumbers");
  if (spectra.wavenumber_cm1.size() < 2)
    file.fail(0, 0, "it has no two rows; expected a heading of states and rows of wavenumbers");
  return spectra;
}

}  // namespace ifov::io
