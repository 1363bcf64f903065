#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/format.h"
#include "io/files/input_file.h"
#include "io/spectra/channel_table.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

struct BandDifference {
  PlotSeries series;
  double worst = 0.0;
  std::string where;
  void add(int number, const std::string& band, double found, double expected) {
    const double off = std::abs(found / expected - 1.0);
    if (off >= worst) worst = off, where = band;
    series.x.push_back(number);
    series.y.push_back(std::max(off, 1e-7));
  }
};

/// A width as the table's program takes it: from the first to the last of 40,001 even points between the rows' ends that reach half of the maximum.
double width_on_points(const radiometry::Spectrum& response) {
  constexpr int kPoints = 40001;
  const double first = response.first_um(), last = response.last_um();
  std::vector<double> values(kPoints);
  double most = 0.0;
  for (int k = 0; k < kPoints; ++k) {
    values[static_cast<std::size_t>(k)] = response.at(first + (last - first) * k / (kPoints - 1));
    most = std::max(most, values[static_cast<std::size_t>(k)]);
  }
  const auto high = [&](double value) { return value >= 0.5 * most; };
  const auto from = std::find_if(values.begin(), values.end(), high);
  const auto to = std::find_if(values.rbegin(), values.rend(), high).base() - 1;
  return (last - first) * static_cast<double>(to - from) / (kPoints - 1);
}

}  // namespace

ReportSection bands_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Bands of instruments";
  section.text =
      "Responses as agencies publish them, of Landsat 8 and 9, Sentinel-2 and 3, MODIS, VIIRS, ASTER, ECOSTRESS, WorldView-3 and SuperDove, "
      "read from their files; centroid, width, solar irradiance (Thuillier et al. 2003) and radiance of a blackbody of 300 K against another program's. "
      "Its widths are those between the first and the last of 40,001 even points that reach half of the maximum, told to 0.01 nm; taken so, all 61 are its own. That of MODIS band 11, 9.952 nm "
      "between straight lines through the rows of its file, is up to two of its steps of 0.0066 nm less there, 9.94 nm: more than the 0.001 that is allowed.";
  const auto table = options.reference.file("sensors/expected_bands.csv"),
             solar = options.reference.file("sensors/solar/Thuillier2003.txt");
  if (!table || !solar || !options.reference.file("sensors/rsr-acolite")) {
    section.not_measured("band_centres", "centres of 61 bands", "sensors");
    return section;
  }
  std::vector<double> um, irradiance;
  for (const auto& row : number_rows(*solar, 2)) {
    um.push_back(row[0] / 1000.0);
    irradiance.push_back(row[1]);
  }
  const radiometry::Spectrum sun(um, irradiance);
  BandDifference centre{{"centroid", "#0072b2", {}, {}, true}, 0.0, {}},
      width{{"width at half maximum", "#d55e00", {}, {}, true}, 0.0, {}},
      on_points{{"width on the table's points", "#56b4e9", {}, {}, true}, 0.0, {}},
      sunlight{{"solar irradiance", "#009e73", {}, {}, true}, 0.0, {}},
      warm{{"radiance at 300 K", "#cc79a7", {}, {}, true}, 0.0, {}};
  std::map<std::string, std::vector<radiometry::Channel>> sensors;
  std::istringstream lines(io::read_input(*table));
  std::string line;
  std::getline(lines, line);
  int bands = 0;
  while (std::getline(lines, line)) {
    std::erase(line, '\r');
    std::stringstream cells(line);
    std::string sensor, band, count, first, last, centroid, fwhm, esun, l300;
    for (std::string* cell : {&sensor, &band, &count, &first, &last, &centroid, &fwhm, &esun, &l300})
      std::getline(cells, *cell, ',');
    auto& channels = sensors[sensor];
    const auto file = options.reference.file("sensors/rsr-acolite/" + sensor + ".txt");
    if (channels.empty() && file) channels = io::read_channels(*file);
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == band; });
    if (found == channels.end()) continue;
    const std::string name = format("{} band {}", sensor, band);
    ++bands;
    centre.add(bands, name, found->centre_um, std::stod(centroid));
    width.add(bands, name, found->fwhm_um, std::stod(fwhm));
    on_points.add(bands, name, width_on_points(found->response), std::stod(fwhm));
    if (esun != "nan" && !esun.empty())
      sunlight.add(bands, name, radiometry::channel_mean(*found, sun), std::stod(esun));
    if (!l300.empty())
      warm.add(bands, name, radiometry::channel_planck_w_m2_sr_um(*found, 300.0), std::stod(l300));
  }
  section.figures.between("bands", bands, 61, 61, "", "bands of the table that were found");
  constexpr double kBandsMost = 1e-3;
  const auto judge = [&](const char* name, const BandDifference& off, const char* what) {
    section.figures.at_most(name, off.worst, kBandsMost, "",
                            format("{}: largest relative difference ({})", what, off.where));
  };
  judge("band_centres", centre, "centroids");
  judge("band_widths", width, "widths at half maximum");
  judge("band_widths_on_points", on_points, "widths as the table's program takes them");
  judge("band_irradiances", sunlight, "solar irradiances");
  judge("band_radiances", warm, "radiances of a blackbody of 300 K");
  Plot plot;
  plot.title = format("Bands of {} instruments against another program", sensors.size());
  plot.x_label = "band, in the order of the table";
  plot.y_label = "relative difference";
  plot.y_log = true;
  plot.series = {centre.series, width.series, on_points.series, sunlight.series, warm.series};
  plot.levels = {{"must", "#00703c", kBandsMost, 0.0}};
  section.plots.push_back({"bands", plot, "Differences below 1e-7 stand at 1e-7."});
  return section;
}

}  // namespace ifov::studies
