#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/format.h"
#include "io/raster/raster.h"
#include "studies/sensor/modulation_scenes.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {
namespace {

constexpr double kWithin = 0.01, kWithinSquare = 0.02;

struct EdgeCase {
  const char *name, *what, *colour;
  double within;
  EdgeResponse found;
  std::function<double(double)> expected;
};

void add_method(const SectionOptions& options, ReportSection& section) {
  const char* picture = "mtf/sfrmat5/Test_edge1_mono.tif";
  const auto file = options.reference.file(picture),
             told = options.reference.file("mtf/sfrmat5/expected_Test_edge1_mono_sfrmat5.csv");
  if (!file || !told)
    return section.not_measured("edge_method", "the evaluation of edges against sfrmat5", picture);
  const io::Raster raster = io::read_raster(*file);
  SensorImage image{raster.height, raster.width, {}, {}, 0};  // its edge is nearly level
  for (int x = 0; x < raster.width; ++x)
    for (int y = 0; y < raster.height; ++y) image.radiance.push_back(static_cast<double>(raster.at(0, y, x)));
  const EdgeResponse found = edge_response(image, {5, true, false});
  double most = 0.0;
  for (const auto& row : number_rows(*told, 2))
    if (row[0] <= 0.5 && row[0] <= found.cycles_px.back())
      most = std::max(most, std::abs(found.at(row[0]) - row[1]));
  section.figures.at_most(
      "edge_method", most, 0.02, "",
      "evaluation of an edge in a photograph (ISO 12233:2023) against sfrmat5: largest difference of modulation");
}

}  // namespace

ReportSection modulation_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Modulation by a slanted edge";
  section.text =
      "An edge 5 degrees aslant, rendered and evaluated as ISO 12233 has it, up to Nyquist's frequency, against the product of the parts: "
      "the pixel's square along the normal of the edge, a Gaussian of 0.5 pixels, the diffraction of an open aperture (lambda N = 1.2 pixels) and of one whose middle is covered to 0.33 of its diameter (0.8 pixels; O'Neill 1956), that together with a Gaussian "
      "of 0.3 pixels, diffusion through 0.2 pixels without a field and crosstalk of 1 % to each neighbour, "
      "smear along the track by the element's length and its way during the exposure, and 16 stages of TDI at a speed 2 % too high, as motion over 0.32 lines. "
      "What the bins of a quarter of a pixel damp (0.026 at Nyquist's frequency) is divided out, which the standard does not do.";
  add_method(options, section);
  const int pixels = options.study.is_quick() ? 96 : 192;
  const EdgeOptics square{}, gaussian{0.5, 0.0}, airy{0.0, 1.2}, covered{0.0, 0.8, 0.33},
      convolved{0.3, 0.8, 0.33, 0.2, 0.01};
  std::vector<EdgeCase> cases;
  for (const auto& [name, what, colour, within, optics] :
       {std::tuple{"edge_square", "square pixel", "#0072b2", kWithinSquare, square},
        std::tuple{"edge_gaussian", "with a Gaussian of 0.5 px", "#d55e00", kWithin, gaussian},
        std::tuple{"edge_diffraction", "with diffraction, 1.2 px", "#009e73", kWithin, airy},
        std::tuple{"edge_obscuration", "with diffraction, 0.8 px, covered to 0.33", "#f0e442", kWithin,
                   covered},
        std::tuple{"edge_product", "that, a Gaussian of 0.3 px, diffusion and crosstalk", "#000000", kWithin,
                   convolved}})
    cases.push_back({name, what, colour, within, still_edge(optics, options.study, pixels),
                     [optics](double v) { return still_modulation(optics, v); }});
  cases.push_back({"edge_smear", "smear along the track", "#cc79a7", kWithin,
                   scanned_edge(1.0, 1, 0.0, options.study, pixels),
                   [](double v) { return scanned_modulation(1.0, 1, 0.0, v); }});
  cases.push_back({"edge_tdi", "TDI of 16 stages, 2 % too fast", "#56b4e9", kWithin,
                   scanned_edge(1.0, 16, 0.02, options.study, pixels),
                   [](double v) { return scanned_modulation(1.0, 16, 0.02, v); }});
  Plot plot, differences;
  plot.title = "Modulation of a slanted edge";
  differences.title = "Modulation of a slanted edge less the product of the parts";
  plot.x_label = differences.x_label = "cycles a pixel across the edge";
  plot.y_label = "modulation";
  differences.y_label = "difference of modulation";
  plot.y_low = 0.0, plot.y_high = 1.05;
  for (const EdgeCase& edge : cases) {
    section.figures.at_most(
        edge.name, edge_difference(edge.found, edge.expected), edge.within, "",
        format("{}: largest difference of modulation up to Nyquist's frequency", edge.what));
    PlotSeries measured{edge.what, edge.colour, {}, {}, true}, product{"", edge.colour, {}, {}, false},
        off{edge.what, edge.colour, {}, {}, false};
    for (std::size_t k = 0; k < edge.found.cycles_px.size(); ++k) {
      const double v = edge.found.cycles_px[k];
      if (k % 2 == 0) measured.x.push_back(v), measured.y.push_back(edge.found.modulation[k]);
      off.x.push_back(v), off.y.push_back(edge.found.modulation[k] - edge.expected(v));
    }
    for (double v = 0.0; v <= 0.5001; v += 0.005)
      product.x.push_back(v), product.y.push_back(edge.expected(v));
    plot.series.push_back(product), plot.series.push_back(measured);
    differences.series.push_back(off);
  }
  differences.levels = {{"must", "#888", kWithin, 0.0}, {"", "#888", -kWithin, 0.0}};
  section.plots.push_back(
      {"edges", plot, "Points: by ISO 12233 out of rendered images. Lines: the product of the parts."});
  section.plots.push_back({"edge_differences", differences, "The square alone may be off by 0.02."});
  return section;
}

ReportSection point_target_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "A point outside the pixel";
  section.text =
      "A disc of a fiftieth of a pixel, hot on cold ground, somewhere in the middle one of 11 x 11 pixels: what each pixel holds of its light "
      "against the energy of the PSF on it, by error functions and by quadrature of the Airy pattern.";
  Plot plot;
  plot.title = "Light of a point in pixels around it";
  plot.x_label = "distance of the pixel's middle from the point, px";
  plot.y_label = "share of the light";
  plot.y_log = true;
  plot.y_low = 1e-5, plot.y_high = 1.0;
  for (const auto& [name, what, colour, optics] :
       {std::tuple{"point_gaussian", "Gaussian of 0.8 px", "#d55e00", EdgeOptics{0.8, 0.0}},
        std::tuple{"point_diffraction", "diffraction, 1.2 px", "#0072b2", EdgeOptics{0.0, 1.2}}}) {
    double most = 0.0;
    PlotSeries found{format("{}, rendered", what), colour, {}, {}, true},
        expected{format("{}, energy of the PSF", what), "#555", {}, {}, true};
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, -0.2}, {0.49, 0.45}}) {
      const PointShares shares = point_shares(optics, x, y, options.study);
      most = std::max(most, shares.largest);
      found.x.insert(found.x.end(), shares.distance_px.begin(), shares.distance_px.end());
      found.y.insert(found.y.end(), shares.found.begin(), shares.found.end());
      expected.y.insert(expected.y.end(), shares.expected.begin(), shares.expected.end());
    }
    expected.x = found.x;
    section.figures.at_most(
        name, 100.0 * most, 0.5, "%",
        format("{}: largest difference of a share, of the total, 0 to 4 pixels away", what));
    plot.series.push_back(expected), plot.series.push_back(found);
  }
  section.plots.push_back({"point", plot, "Three places of the point within its pixel."});
  return section;
}

}  // namespace ifov::studies
