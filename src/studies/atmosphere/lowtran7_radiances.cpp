#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/column/atmosphere_column.h"
#include "atmosphere/scattering/column_solver.h"
#include "atmosphere/thermal/thermal_column.h"
#include "core/format.h"
#include "radiometry/planck.h"
#include "studies/atmosphere/lowtran7_layers.h"
#include "studies/atmosphere/lowtran7_runs.h"

namespace ifov::studies {
namespace {

using namespace atmosphere;

struct Spectrum {
  std::vector<double> nu, ours, layered, theirs;  // W m-2 sr-1 um-1
};

Spectrum thermal_run(const std::filesystem::path& file, const std::string& model, double mu,
                     double ground_k) {
  AtmosphereDescription description = as_in_1986(model);
  description.aerosol.type = "none";
  ColumnOptions column_options;
  column_options.terms = 8;
  column_options.most_terms = 32;
  const AtmosphereColumn column(description, column_options);
  const double observer_km = mu > 0.0 ? 200.0 : 0.0;
  Spectrum result;
  for (const auto& row : number_rows(file, 4)) {
    if (row.size() != 4 || row[0] < 500.0 || row[0] > 3000.0 || std::fmod(row[0], 10.0) != 0.0) continue;
    const ColumnOptics optics = column.at(row[0]);
    const double um = optics.wavelength_um;
    const double ground = ground_k > 0.0 ? radiometry::planck_w_m2_sr_um(um, ground_k) : 0.0;
    std::vector<double> planck;
    for (double t : column.levels().temperature_K) planck.push_back(radiometry::planck_w_m2_sr_um(um, t));
    double ours = 0.0, layered = 0.0;
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const LayerOptics layers = optics.term(term);
      const auto radiance = [&](const ThermalColumn& thermal) {
        const ThermalPath path = thermal.path(observer_km, mu);
        return optics.weight(term) * (path.radiance + path.transmittance * ground);
      };
      const UniformLayers uniform(column.levels(), layers.gas_absorption, um);
      layered += radiance(ThermalColumn(uniform.altitude_km, uniform.planck, uniform.depth));
      ours += radiance(ThermalColumn(column.levels().altitude_km, planck, layers.gas_absorption));
    }
    result.nu.push_back(row[0]);
    result.ours.push_back(ours);
    result.layered.push_back(layered);
    result.theirs.push_back(row[2] / (um * um * 1e-8));
  }
  return result;
}

void add_thermal(const SectionOptions& options, AtmosphereSection& section) {
  struct Run {
    std::string name, file, model;
    double mu, ground_k;
  };
  Plot plot;
  plot.title = "Thermal radiance against LOWTRAN7, relative difference";
  plot.x_label = "wavenumber, cm-1";
  plot.y_label = "difference, %";
  plot.y_low = -2.0;
  plot.y_high = 10.0;
  plot.levels = {{"", "#888", 0.0, 1.0}};
  const char* colours[] = {"#0072b2", "#009e73", "#cc79a7"};
  int which = 0;
  for (const Run& run :
       {Run{"thermal_nadir", "C_US76_noaerosol_nadir100km_thermal_T300", "US standard 1976", 1.0, 300.0},
        Run{"thermal_zenith", "D0_MLS_noaerosol_sky_zenith_thermal", "mid-latitude summer", -1.0, 0.0},
        Run{"thermal_slant", "D60_MLS_noaerosol_sky_60deg_thermal", "mid-latitude summer", -0.5, 0.0}}) {
    const auto path = options.reference.file("atmosphere/lowtran7/" + run.file + ".tape7.txt");
    if (!path) {
      section.not_measured("lowtran7_" + run.name, "thermal radiance", run.file);
      continue;
    }
    const Spectrum spectrum = thermal_run(*path, run.model, run.mu, run.ground_k);
    double sum = 0.0, sum_ours = 0.0, total = 0.0;
    std::vector<double> all, ours_percent, layered_percent;
    for (std::size_t k = 0; k < spectrum.nu.size(); ++k) {
      sum += spectrum.layered[k] - spectrum.theirs[k];
      sum_ours += spectrum.ours[k] - spectrum.theirs[k];
      total += spectrum.theirs[k];
      const double nu = spectrum.nu[k];
      const bool high = run.mu > 0.0 && ((nu >= 600.0 && nu < 720.0) || (nu >= 2200.0 && nu < 2400.0));
      if (!high) all.push_back(std::abs(spectrum.layered[k] / spectrum.theirs[k] - 1.0));
      ours_percent.push_back(100.0 * (spectrum.ours[k] / spectrum.theirs[k] - 1.0));
      layered_percent.push_back(100.0 * (spectrum.layered[k] / spectrum.theirs[k] - 1.0));
    }
    std::sort(all.begin(), all.end());
    const std::string what = run.mu > 0.0 ? "radiance at 100 km above ground of 300 K" : "sky radiance";
    section.figures.at_most("lowtran7_" + run.name, 100.0 * std::abs(sum) / total, 1.0, "%",
                            format("{}, {}, layers as the program has them: difference over 500 to 3000 cm-1",
                                   what, run.mu == -0.5 ? "60 degrees from the zenith" : "vertical"));
    section.figures.at_most(
        "lowtran7_" + run.name + "_95", 100.0 * all[all.size() * 95 / 100], 1.0, "%",
        run.mu > 0.0 ? "difference that 95 % of the wavenumbers stay below, without the stratosphere's "
                       "bands at 600 to 720 and 2200 to 2400 cm-1"
                     : "difference that 95 % of the wavenumbers stay below");
    section.figures.report("lowtran7_" + run.name + "_own_layers", 100.0 * sum_ours / total, "%",
                           "the same with our sources, linear in optical depth");
    const std::string name = run.mu > 0.0 ? "nadir" : run.mu == -0.5 ? "sky at 60 degrees" : "sky at zenith";
    plot.series.push_back({name, colours[which], spectrum.nu, layered_percent});
    if (run.name == "thermal_zenith")
      plot.series.push_back({"sky at zenith, our layers", "#999999", spectrum.nu, ours_percent});
    ++which;
  }
  if (!plot.series.empty())
    section.plots.push_back({"lowtran7_thermal", plot,
                             "With layers of one temperature each, as the program has them, both agree. Our "
                             "own sources are linear in "
                             "optical depth (grey): the opaque sky of the program is that of half a "
                             "kilometre up and too dark. Seen from "
                             "space, levels above 25 km differ near 667 and 2350 cm-1."});
}

void add_scattering(const SectionOptions& options, AtmosphereSection& section) {
  const auto single = options.reference.file(
      "atmosphere/lowtran7/E_MLS_rural23_nadir100km_sun45_singlescat_albedo0p2.tape7.txt");
  const auto multiple = options.reference.file(
      "atmosphere/lowtran7/Em_MLS_rural23_nadir100km_sun45_multscat_albedo0p2.tape7.txt");
  if (!single || !multiple)
    return section.not_measured("lowtran7_solar", "path radiance in sunlight", "runs E and Em");
  const AtmosphereColumn column(as_in_1986("mid-latitude summer"));
  const ColumnSolver solver;
  const auto with = number_rows(*multiple, 9);
  constexpr double kAlbedo = 0.2;
  PlotSeries once{"scattered once", "#0072b2", {}, {}}, all{"all path radiance", "#d55e00", {}, {}},
      ground{"ground, all light", "#009e73", {}, {}};
  double blue = 0.0, worst_ground = 0.0;
  for (const auto& row : number_rows(*single, 9)) {
    // Below are bands of absorption, in which the direct light is a poor measure.
    if (row[0] < 14500.0 || row[0] > 30600.0 ||
        std::fmod(row[0], options.study.is_quick() ? 1800.0 : 600.0) != 0.0)
      continue;
    const auto other = std::find_if(with.begin(), with.end(), [&](const auto& r) { return r[0] == row[0]; });
    if (other == with.end()) continue;
    const ColumnOptics optics = column.at(row[0]);
    double path_once = 0.0, path_all = 0.0, lit = 0.0, direct = 0.0;
    for (std::size_t term = 0; term < optics.terms(); ++term) {
      const ColumnSolution solution =
          solver.solve(column.levels(), optics.term(term), 0.25 * std::numbers::pi);
      const PathLight path = solution.sunlit().path({1.0, 0.0}, 200.0);
      const FluxProfile::Fluxes fluxes = solution.sunlit().fluxes().at(0.0);
      const double bright =
          (fluxes.direct_down + fluxes.diffuse_down) / (1.0 - kAlbedo * solution.spherical_albedo());
      const double weight = optics.weight(term),
                   reflected = weight * kAlbedo / std::numbers::pi * path.transmittance;
      direct += reflected * fluxes.direct_down;
      lit += reflected * bright;
      path_once += weight * path.single.i;
      path_all += weight * (path.radiance().i + kAlbedo / std::numbers::pi * bright *
                                                    solution.diffuse_transmittance(1.0, 200.0).i);
    }
    // By the sunlight that the ground reflects straight to the sensor, which takes the solar spectrum out.
    const double x = 1e4 / row[0];
    const double difference_once = path_once / direct / (row[4] / row[6]) - 1.0;
    const double difference_ground = lit / direct / ((*other)[5] / (*other)[6]) - 1.0;
    if (row[0] >= 24000.0) blue = std::max(blue, std::abs(difference_once));
    if (row[0] >= 15000.0) worst_ground = std::max(worst_ground, std::abs(difference_ground));
    once.x.push_back(x), once.y.push_back(100.0 * difference_once);
    all.x.push_back(x), all.y.push_back(100.0 * (path_all / direct / ((*other)[3] / (*other)[6]) - 1.0));
    ground.x.push_back(x), ground.y.push_back(100.0 * difference_ground);
  }
  section.figures.at_most(
      "lowtran7_single_scattering", 100.0 * blue, 1.0, "%",
      "light scattered once, 0.33 to 0.42 um, where molecules scatter most of it: largest difference");
  section.figures.at_most(
      "lowtran7_ground_light", 100.0 * worst_ground, 1.5, "%",
      "light that the ground reflects, with all scattering, 0.33 to 0.67 um: largest difference");
  double least = 0.0, most = 0.0;
  for (std::size_t k = 0; k < all.x.size(); ++k) {
    if (all.x[k] > 0.7) continue;
    least = std::min(least, all.y[k]);
    most = std::max(most, all.y[k]);
  }
  section.figures.report("lowtran7_path_most", most, "%",
                         "all path radiance below 0.7 um, ours less theirs: the most (two streams, scalar)");
  section.figures.report("lowtran7_path_least", least, "%", "and the least");
  Plot plot;
  plot.title = "Sunlight at 100 km, rural haze, against LOWTRAN7";
  plot.x_label = "wavelength, um";
  plot.y_label = "difference, %";
  plot.levels = {{"", "#888", 0.0, 1.0}};
  plot.y_low = -10.0;
  plot.y_high = 20.0;
  plot.series = {once, all, ground};
  section.plots.push_back(
      {"lowtran7_solar", plot,
       "Nadir, Sun at 45 degrees, 23 km visibility. Light that we call scattered once has some in it that went into "
       "haze's forward peak before. The program's multiple scattering has two streams and no polarization."});
}

}  // namespace

void add_lowtran7_radiances(const SectionOptions& options, AtmosphereSection& section) {
  add_thermal(options, section);
  add_scattering(options, section);
}

}  // namespace ifov::studies
