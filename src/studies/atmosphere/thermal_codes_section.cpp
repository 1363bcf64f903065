#include <cmath>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/thermal/thermal_column.h"
#include "core/format.h"
#include "radiometry/planck.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;

void add_flux(const SectionOptions& options, AtmosphereSection& section) {
  const std::string name = "atmosphere/libradtran/spectrum_terrestrial_reptran.OUT";
  const auto file = options.reference.file(name);
  if (!file) return section.not_measured("reptran_flux", "REPTRAN fine, thermal flux down", name);
  AtmosphereDescription description;
  description.air.model = "subarctic summer";
  description.air.ozone_DU = 300.0;
  description.aerosol.type = "none";
  const AtmosphereColumn column(description);
  const GaussNodes nodes = gauss_nodes(8);
  const auto rows = number_rows(*file, 3);
  constexpr double kFirst = 255.0, kLast = 2900.0, kPlotStep = 60.0;
  double ours = 0.0, theirs = 0.0, part = 0.0;
  PlotSeries line{"ifov", "#0072b2", {}, {}}, reference{"REPTRAN fine", "#d55e00", {}, {}};
  for (double nu = kFirst; nu < kLast; nu += 5.0) {
    const ColumnOptics optics = column.at(nu);
    const double um = optics.wavelength_um;
    std::vector<double> planck;
    for (double t : column.levels().temperature_K) planck.push_back(radiometry::planck_w_m2_sr_um(um, t));
    double flux = 0.0;
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const LayerOptics layers = optics.term(term);
      const ThermalColumn thermal(column.levels().altitude_km, planck, layers.gas_absorption);
      flux += 5.0 * optics.weight(term) * thermal.radiances(nodes, {0.7, planck[0]}).flux_down[0] * um * um *
              1e-4;
    }
    ours += flux;
    part += flux;
    if (std::fmod(nu - kFirst, kPlotStep) != kPlotStep - 5.0) continue;
    line.x.push_back(nu - 0.5 * kPlotStep + 2.5), line.y.push_back(part / kPlotStep);
    part = 0.0;
  }
  std::vector<double> sums(line.x.size(), 0.0);
  for (const auto& row : rows) {
    if (row[1] < kFirst - 2.5 || row[1] >= kLast - 2.5) continue;
    theirs += row[2];
    const std::size_t bin = static_cast<std::size_t>((row[1] - (kFirst - 2.5)) / kPlotStep);
    if (bin < sums.size()) sums[bin] += row[2] / kPlotStep;
  }
  reference.x = line.x;
  reference.y = sums;
  section.figures.at_most(
      "reptran_flux", 100.0 * std::abs(ours / theirs - 1.0), 1.5, "%",
      format("REPTRAN fine, thermal flux down in the subarctic summer, 255 to 2900 cm-1 ({:.1f} W m-2): "
             "difference",
             theirs));
  Plot plot;
  plot.title = "Thermal flux that comes down to the ground, subarctic summer";
  plot.x_label = "wavenumber, cm-1";
  plot.y_label = "W m-2 per cm-1";
  plot.series = {reference, line};
  section.plots.push_back({"reptran_flux", plot, "Means over 60 cm-1."});
}

/// Columns of transmittance as both programs print them.
enum Column { kLines = 2, kMixedGases = 3, kNitrogen = 6, kWaterContinuum = 7 };
double product(const std::vector<double>& row) { return row[2] * row[3] * row[4] * row[5] * row[6] * row[7]; }

void add_windows(const SectionOptions& options, AtmosphereSection& section) {
  const std::string name = "atmosphere/modtran_tape7_pyradi/horizon5kmtropical_first12cols.txt";
  const auto file = options.reference.file(name);
  if (!file) return section.not_measured("modtran5_windows", "MODTRAN5, 5 km at the ground", name);
  ProfileDescription description;
  description.model = "tropical";
  description.co2_ppm = 360.0;
  description.ch4_ppm = 1.7;
  description.n2o_ppm = 0.32;
  const Profile profile = build_profile(description).profile;
  const GasAmounts path = horizontal_amounts(profile, 0.0, 5.0);
  const auto rows = number_rows(*file, 12);
  for (const auto& [first, last] : std::vector<std::pair<double, double>>{{750, 1250},
                                                                          {1900, 2250},
                                                                          {2250, 2450},
                                                                          {2450, 2900},
                                                                          {4000, 4900},
                                                                          {5600, 6700},
                                                                          {7500, 9100},
                                                                          {9300, 10300}}) {
    Differences window;
    for (const auto& row : rows)
      if (row[0] >= first && row[0] <= last)
        window.add(gas_transmittance(row[0], path, GasModel::standard), product(row));
    section.figures.between(format("modtran5_{:g}_{:g}", first, last), window.mean(), -0.03, 0.03, "",
                            format("MODTRAN5, 5 km at the ground, tropical: mean of our transmittance less "
                                   "theirs, {:g} to {:g} cm-1",
                                   first, last));
  }
}

/// Whose the differences are: what LOWTRAN7 itself printed for that path, by kind of gas, less MODTRAN5.
void add_lowtran7_windows(const SectionOptions& options, AtmosphereSection& section) {
  const std::string theirs = "atmosphere/modtran_tape7_pyradi/horizon5kmtropical_first12cols.txt",
                    own = "atmosphere/lowtran7/G_TROP_rural23_horizontal5km_trans.tape7.txt";
  const auto modtran = options.reference.file(theirs), lowtran = options.reference.file(own);
  if (!modtran || !lowtran)
    return section.not_measured("lowtran7_windows", "LOWTRAN7's own output for that path", own);
  constexpr double kNitrogenEnd_cm1 = 2740.0;
  const auto mean_of = [](const std::vector<std::vector<double>>& rows, double first, double last,
                          Column column) {
    double sum = 0.0, count = 0.0;
    for (const auto& row : rows)
      if (row[0] >= first && row[0] <= last) sum += row[column], ++count;
    return sum / count;
  };
  const auto modtran_rows = number_rows(*modtran, 12), lowtran_rows = number_rows(*lowtran, 12);
  for (const auto& [first, last] :
       std::vector<std::pair<double, double>>{{2450, 2900}, {4000, 4900}, {10300, 11500}, {11500, 13000}})
    for (const auto& [column, what] : {std::pair{kLines, "lines of water"},
                                       {kMixedGases, "carbon dioxide, methane, nitrous oxide, oxygen"},
                                       {kNitrogen, "continuum of nitrogen"},
                                       {kWaterContinuum, "continuum of water"}}) {
      if (column == kNitrogen && first > kNitrogenEnd_cm1) continue;
      section.figures.report(
          format("lowtran7_less_modtran5_{:g}_{:g}_{}", first, last, static_cast<int>(column)),
          mean_of(lowtran_rows, first, last, column) - mean_of(modtran_rows, first, last, column), "",
          format("LOWTRAN7's own output for that path less MODTRAN5's, {:g} to {:g} cm-1: {}", first, last,
                 what));
    }
}

/// Whether these explain what our transmittance differs by: MODTRAN5's, with the lines and the nitrogen that LOWTRAN7 itself printed.
void add_exchanged_lines(const SectionOptions& options, AtmosphereSection& section) {
  constexpr double kFirst_cm1 = 2450.0, kLast_cm1 = 2900.0;
  const auto modtran =
      options.reference.file("atmosphere/modtran_tape7_pyradi/horizon5kmtropical_first12cols.txt");
  const auto lowtran =
      options.reference.file("atmosphere/lowtran7/G_TROP_rural23_horizontal5km_trans.tape7.txt");
  if (!modtran || !lowtran) return;
  const auto lowtran_rows = number_rows(*lowtran, 12);
  Differences window;
  std::size_t at = 0;
  for (const auto& row : number_rows(*modtran, 12)) {
    if (row[0] < kFirst_cm1 || row[0] > kLast_cm1) continue;
    while (at + 2 < lowtran_rows.size() && lowtran_rows[at + 1][0] < row[0]) ++at;
    const auto &low = lowtran_rows[at], &high = lowtran_rows[at + 1];
    const double share = (row[0] - low[0]) / (high[0] - low[0]);
    std::vector<double> exchanged = row;
    for (const Column column : {kLines, kMixedGases, kNitrogen})
      exchanged[column] = low[column] + share * (high[column] - low[column]);
    window.add(product(exchanged), product(row));
  }
  section.figures.report(
      "modtran5_with_lowtran7_lines_2450_2900", window.mean(), "",
      format("MODTRAN5's own output with these lines, gases and nitrogen of LOWTRAN7 in place of its own "
             "less MODTRAN5's, {:g} to {:g} cm-1: what ours must differ by, if it is they",
             kFirst_cm1, kLast_cm1));
}

}  // namespace

AtmosphereSection thermal_codes_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "Thermal light, against other programs";
  section.text =
      "The sky's flux against REPTRAN, and windows of a long moist path (9.5 g cm-2 of water) against "
      "MODTRAN5, gases alone. From 2450 to 2900 cm-1 it is the band model itself that absorbs too much on "
      "such a path: LOWTRAN7's own output has the same lines of water and the same methane and nitrous oxide "
      "too opaque, and its continuum on top, which is changed here. Exchanging these lines alone in MODTRAN5's output makes all of the difference. Nothing that the model lacks could mend "
      "that: it would absorb still more. Around 0.94 and 0.82 um (10300 to 13000 cm-1) its lines of water "
      "are too weak.";
  add_flux(options, section);
  add_windows(options, section);
  add_lowtran7_windows(options, section);
  add_exchanged_lines(options, section);
  return section;
}

}  // namespace ifov::studies
