#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.h"
#include "sensor/mtf.h"
#include "studies/sensor/channel_scenes.h"
#include "studies/sensor/sensor_sections.h"

namespace ifov::studies {

ReportSection channels_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Footprints by channel";
  section.text =
      "One run of an aperture whose diffraction is each channel's own (0.54 pixels at 0.45 um, 2.64 at 2.2 um for the edges; 0.4, 0.7 and 1.1 pixels at "
      "4, 7 and 11 um for points). MTF50 is where the modulation of the edge over that of the square falls to a half; frequencies of one aperture are as "
      "wavelengths are, the other way. What light lies beyond the image is lost to the evaluation, which makes the modulation of long wavelengths higher. The planted fault, one footprint for all channels, has the ratio 1.";
  const ChannelOptics optics{1.2, 0.25, false};
  const ChannelEdges found = channel_edges(optics, options.study, options.study.is_quick() ? 384 : 768);
  const double expected = found.wavelength_um.back() / found.wavelength_um.front();
  section.figures.between("mtf50_ratio", found.ratio(), 0.99 * expected, 1.01 * expected, "",
                          "MTF50 of diffraction at 0.45 um over that at 2.2 um, of edges in one run");
  Plot plot;
  plot.title = "Modulation of two channels of one run";
  plot.x_label = "cycles a pixel across the edge";
  plot.y_label = "modulation of the optics";
  plot.y_low = 0.0, plot.y_high = 1.05;
  for (std::size_t k = 0; k < found.edges.size(); ++k) {
    const double q_px = optics.q_px_um * found.wavelength_um[k];
    const char* colour = k == 0 ? "#0072b2" : "#d55e00";
    PlotSeries measured{format("{:g} um", found.wavelength_um[k]), colour, {}, {}, true},
        form{"", colour, {}, {}, false};
    const EdgeResponse& edge = found.edges[k];
    double most = 0.0;
    for (std::size_t n = 0; n < edge.cycles_px.size(); ++n) {
      const double v = edge.cycles_px[n], of_optics = edge.modulation[n] / square_across(optics, v);
      if (v <= 0.5)
        most = std::max(most, std::abs(edge.modulation[n] -
                                       sensor::diffraction_mtf(q_px, 0.0, v) * square_across(optics, v)));
      form.x.push_back(v), form.y.push_back(sensor::diffraction_mtf(q_px, 0.0, v));
      if (n % 4 == 0) measured.x.push_back(v), measured.y.push_back(of_optics);
    }
    section.figures.at_most(format("edge_channel_{}", k), most, 0.01, "",
                            format("largest difference of modulation at {:g} um up to Nyquist's frequency",
                                   found.wavelength_um[k]));
    plot.series.push_back(form), plot.series.push_back(measured);
  }
  section.plots.push_back(
      {"channels", plot,
       "Points: of edges, over the square's modulation. Lines: diffraction of an open aperture."});
  std::vector<double> most;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, -0.2}, {0.49, 0.45}}) {
    const std::vector<double> off = channel_points_off({0.1, 1.0, false}, x, y, options.study);
    most.resize(off.size(), 0.0);
    for (std::size_t k = 0; k < off.size(); ++k) most[k] = std::max(most[k], off[k]);
  }
  for (std::size_t k = 0; k < most.size(); ++k)
    section.figures.at_most(
        format("point_channel_{}", k), 100.0 * most[k], 0.5, "%",
        format("a point at {} um: largest difference of a share, of the total, 0 to 4 pixels away",
               std::array{4, 7, 11}[k]));
  return section;
}

}  // namespace ifov::studies
