#include <cmath>

#include "core/format.h"
#include "studies/sensor/scanning_images.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

ReportSection scanning_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Scanned images";
  const int lines = options.study.is_quick() ? 32 : 64;
  constexpr int kCells = 100;
  section.text = format(
      "Bright discs seen by a line scanner, 24 x {} pixels at 1 %, whose intervals hold 95 % of what they are asked for: against the image of "
      "parallel rays where it flies at the speed of its lines, and against the mean of {} x {} points a pixel at other speeds and with "
      "1 mrad of roll, 20 pixels to and fro nine times a second.",
      lines, kCells, kCells);
  constexpr double kLeastHeld = 0.95;
  ScannerFlight plain;
  plain.lines = lines;
  const std::vector<double> truth = discs_by_geometry(plain, kCells);
  const SensorImage scanned = scan_discs(plain, options.study),
                    above = discs_from_above(plain, options.study);
  const HeldShares same = held_shares(scanned, above, truth);
  section.figures.at_least("scan_orthographic_held", same.all, kLeastHeld, "",
                           "at the speed of its lines, against parallel rays: pixels within both intervals");
  section.figures.between("scan_orthographic_samples",
                          static_cast<double>(scanned.samples) / static_cast<double>(above.samples), 0.9, 1.1,
                          "", "samples of the scanned image over those of parallel rays");
  Plot plot;
  plot.title = "Scanned pixels against geometry";
  plot.x_label = "share of the disc in the pixel";
  plot.y_label = "error over the half-width";
  plot.levels = {{"interval", "#888", 1.0, 0.0}, {"", "#888", -1.0, 0.0}};
  const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"};
  int index = 0;
  for (const double roll : {0.0, 1e-3})
    for (const double speed : {25.0, 50.0, 150.0}) {
      ScannerFlight flight = plain;
      flight.speed_m_s = speed, flight.roll_rad = roll;
      const SensorImage image = scan_discs(flight, options.study);
      const std::vector<double> expected = discs_by_geometry(flight, kCells);
      const HeldShares shares = held_shares(image, expected);
      const std::string what =
          format("{:g} times the speed of its lines{}", speed / 50.0, roll > 0.0 ? ", rolling" : "");
      const std::string name = format("scan_{:g}{}", speed / 50.0, roll > 0.0 ? "_rolling" : "");
      section.figures.at_least(name, shares.all, kLeastHeld, "", what + ": pixels within their interval");
      section.figures.report(name + "_edges", shares.edges, "", "of those that hold an edge of a disc");
      section.figures.report(name + "_worst", shares.worst, "",
                             "largest departure beyond the half-width, of the contrast");
      PlotSeries series{
          format("{:g}{}", speed / 50.0, roll > 0.0 ? ", rolling" : ""), colours[index++], {}, {}, true};
      for (std::size_t p = 0; p < expected.size(); ++p) {
        const double share = (expected[p] - 10.0) / 20.0;
        if (share < 1e-4 || share > 1.0 - 1e-4) continue;
        series.x.push_back(share);
        series.y.push_back((image.radiance[p] - expected[p]) / image.half_width[p]);
      }
      plot.series.push_back(series);
    }
  section.plots.push_back(
      {"scanning", plot,
       "Pixels that hold an edge, by speed over that of the lines. Geometry's mean over points is itself off by up to 0.001 of the contrast."});
  return section;
}

}  // namespace ifov::studies
