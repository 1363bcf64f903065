#include <algorithm>
#include <cmath>

#include "atmosphere/gas/gas_transmittance.h"
#include "core/format.h"
#include "studies/atmosphere/lowtran7_layers.h"
#include "studies/atmosphere/lowtran7_runs.h"

namespace ifov::studies {

using namespace atmosphere;

AtmosphereDescription as_in_1986(const std::string& model) {
  AtmosphereDescription description;
  description.air.model = model;
  description.air.co2_ppm = description.air.ch4_ppm = description.air.n2o_ppm = std::nullopt;
  description.gas_model = GasModel::lowtran7;
  return description;
}

namespace {

/// A vertical path on the program's own levels, with the temperature of the water continuum taken at the mean
/// of each layer, as the program does; we follow it through the layer, which changes a transmittance by up to
/// 0.003.
GasAmounts vertical_as_the_program(const Profile& profile) {
  Profile kept;
  for (std::size_t i = 0; i < profile.levels(); ++i) {
    if (!program_level(profile.altitude_km[i])) continue;
    kept.altitude_km.push_back(profile.altitude_km[i]);
    kept.pressure_hPa.push_back(profile.pressure_hPa[i]);
    kept.temperature_K.push_back(profile.temperature_K[i]);
    for (std::size_t g = 0; g < kGasCount; ++g)
      kept.mixing_ratio_ppmv[g].push_back(profile.mixing_ratio_ppmv[g][i]);
  }
  const std::vector<GasAmounts> layers = layer_amounts(kept, kept.altitude_km);
  GasAmounts sum;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    GasAmounts layer = layers[l];
    const double a = kept.air_per_cm3(l), b = kept.air_per_cm3(l + 1);
    const double mean = (a * kept.temperature_K[l] + b * kept.temperature_K[l + 1]) / (a + b);
    layer.water_self_cold = layer.water_self * std::clamp((296.0 - mean) / 36.0, 0.0, 1.0);
    sum.add(layer, 1.0);
  }
  return sum;
}

void add_transmittance(const SectionOptions& options, AtmosphereSection& section) {
  const std::string file = "atmosphere/lowtran7/G_TROP_rural23_horizontal5km_trans.tape7.txt";
  const std::string vertical = "atmosphere/lowtran7/A_MLS_vertical_noaerosol_trans.tape7.txt";
  for (const auto& [name, path_of, meaning] :
       {std::tuple{"lowtran7_horizontal", file,
                   "transmittance of all gases over 5 km at the ground, tropical"},
        std::tuple{"lowtran7_vertical", vertical, "the same from ground to space, mid-latitude summer"}}) {
    const auto path = options.reference.file(path_of);
    if (!path) {
      section.not_measured(name, meaning, path_of);
      continue;
    }
    const bool horizontal = path_of == file;
    const AtmosphereColumn column(as_in_1986(horizontal ? "tropical" : "mid-latitude summer"));
    const GasAmounts amounts = horizontal ? horizontal_amounts(column.profile(), 0.0, 5.0)
                                          : vertical_as_the_program(column.profile());
    Differences difference;
    PlotSeries ours{"ifov, gases", "#0072b2", {}, {}}, theirs{"LOWTRAN7, gases", "#d55e00", {}, {}};
    for (const auto& row : number_rows(*path, 13)) {
      if (row[0] < 400.0) continue;
      const double reference = row[2] * row[3] * row[4] * row[5] * row[6] * row[7];
      const double value = gas_transmittance(row[0], amounts, GasModel::lowtran7);
      difference.add(value, reference);
      if (row[0] < 6000.0) {
        ours.x.push_back(row[0]), ours.y.push_back(value);
        theirs.x.push_back(row[0]), theirs.y.push_back(reference);
      }
    }
    section.figures.at_most(name, difference.largest(), 0.002, "",
                            format("{}: largest difference at {} wavenumbers", meaning, difference.count()));
    if (horizontal) {
      Plot plot;
      plot.title = "5 km at the ground, tropical air";
      plot.x_label = "wavenumber, cm-1";
      plot.y_label = "transmittance of gases";
      plot.y_high = 1.0;
      plot.series = {theirs, ours};
      section.plots.push_back({"lowtran7_transmittance", plot, "Both curves lie on each other."});
    }
  }
}

}  // namespace

AtmosphereSection lowtran7_section(const SectionOptions& options) {
  AtmosphereSection section;
  section.title = "LOWTRAN7's own runs";
  section.text =
      "The band model is that of LOWTRAN7 (Kneizys et al. 1988). With its continuum and its gases of 1986, "
      "our columns "
      "must repeat what the original program prints.";
  add_transmittance(options, section);
  add_lowtran7_radiances(options, section);
  return section;
}

}  // namespace ifov::studies
