#include "studies/suburb/suburb_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/spectral_projection.h"
#include "core/format.h"
#include "studies/common/html_page.h"
#include "studies/common/report_plot.h"
#include "studies/suburb/image_curves_report.h"
#include "studies/suburb/scatter_plots.h"

namespace ifov::studies {

namespace {

using analysis::CubeView;
using analysis::SpectralAxes;

/// Rows of the paper's table 2.
struct PaperRow {
  const char *samples, *materials, *time;
};
constexpr PaperRow kPaper[] = {{"1/1/1", "1.00", "1"},
                               {"25/25/25", "1.51", "25"},
                               {"100/100/100", "1.58", "100"},
                               {"25/52/100", "1.65", "47"}};

const char* role(const SceneResults& r, std::size_t k) {
  if (k == r.chosen) return " (judged)";
  return k == r.chosen_by_largest ? " (by the largest error)" : "";
}

std::string table_2(const SceneResults& r) {
  std::string rows;
  for (std::size_t k = 0; k < r.results.size(); ++k) {
    const SceneResult& s = r.results[k];
    const PaperRow paper = k < std::size(kPaper) ? kPaper[k] : PaperRow{"", "", ""};
    rows += format(
        "<tr><td>{}{}</td><td class=\"n\">{}/{:.1f}/{}</td><td class=\"n\">{}</td><td class=\"n\">{:.3f}</td><td "
        "class=\"n\">{:.3f}</td><td class=\"n\">{}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{}</td><td "
        "class=\"n\">{:.1f}</td><td class=\"n\">{:.4f}</td><td class=\"n\">{:.3f}</td><td class=\"n\">{:.3f}</td><td "
        "class=\"n\">{:.3f}</td></tr>\n",
        html_text(s.name), role(r, k), s.fewest_samples, s.samples_per_px, s.most_samples, paper.samples,
        s.materials.counted, s.materials.raw, paper.materials, s.seconds / r.results[0].seconds, paper.time,
        s.seconds, s.abundances.rms, s.over_grid.mean, s.over_grid.worst, s.over_grid.largest);
  }
  return "<table><tr><th>sampling</th><th>samples per pixel, least/mean/most</th><th>paper</th><th>materials per "
         "pixel, at least 0.1 %</th><th>raw</th><th>paper</th><th>time over one ray</th><th>paper</th><th>seconds"
         "</th><th>abundances, RMS error</th><th>radiance, RMS error over 10 x 10, mean band</th><th>the same, worst band</th><th>largest of all "
         "bands, over the largest of 10 x 10</th></tr>\n" +
         rows + "</table>\n";
}

ImagePanel panel_of(const ImageStore& image, const std::string& title, std::vector<double> values,
                    double share, const std::string& unit) {
  std::vector<double> sorted = values;
  const std::size_t at = static_cast<std::size_t>(share * double(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(at), sorted.end());
  const double high = sorted[at];
  return {title, image.width(), image.height(), std::move(values), 0.0, high, unit, false};
}

std::string sample_map(const SceneResult& result, ReportFigures& figures) {
  const auto& samples = result.image->samples();
  return figures.add(panel_of(*result.image, "samples per pixel: " + result.name,
                              {samples.begin(), samples.end()}, 0.995, "samples"));
}

std::string radiance_map(const SceneResults& r, const SceneResult& result, double wavelength_um,
                         ReportFigures& figures) {
  std::size_t nearest = 0;
  for (std::size_t c = 0; c < r.wavelengths_um.size(); ++c)
    if (std::abs(r.wavelengths_um[c] - wavelength_um) < std::abs(r.wavelengths_um[nearest] - wavelength_um))
      nearest = c;
  std::vector<double> values;
  for (std::size_t p = 0; p < result.image->samples().size(); ++p)
    values.push_back(double(result.image->mean()[p * r.wavelengths_um.size() + nearest]));
  return figures.add(panel_of(*result.image,
                              format("{} at {:.2f} µm", result.name, r.wavelengths_um[nearest]),
                              std::move(values), 0.99, "W m⁻² sr⁻¹ µm⁻¹"));
}

std::string rms_plot(const SceneResults& r, ReportFigures& figures) {
  Plot plot;
  plot.title = "Error of radiance by wavelength";
  plot.x_label = "wavelength, µm";
  plot.y_label = "RMS error, W m⁻² sr⁻¹ µm⁻¹";
  plot.y_log = true;
  const char* const colours[] = {"#bbb", "#888", "#333", "#c2571a", "#0b6fb8"};
  const std::size_t shown[] = {0, 1, 2, 3, r.chosen};
  for (std::size_t k = 0; k < std::size(shown); ++k) {
    const SceneResult& s = r.results[shown[k]];
    plot.series.push_back({s.name, colours[k], r.wavelengths_um, s.errors.rms});
  }
  return figures.add(plot);
}

std::vector<std::uint8_t> dominant_materials(const ImageStore& image) {
  std::vector<std::uint8_t> dominant;
  for (std::size_t p = 0; p < image.samples().size(); ++p) {
    const auto shares = image.abundances(p);
    const auto largest = std::max_element(
        shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.fraction < b.fraction; });
    dominant.push_back(
        largest == shares.end() ? 0 : static_cast<std::uint8_t>(std::min(255u, largest->material)));
  }
  return dominant;
}

std::string scatter_plot(const SceneResults& r) {
  const auto cube_of = [&](const ImageStore& image) {
    return CubeView{image.mean(), image.width(), image.height(), image.columns()};
  };
  const CubeView own = cube_of(*r.results[r.chosen].image);
  const SpectralAxes principal = principal_axes(own, kScatterPlotAxes);
  const SpectralAxes noise_fraction = minimum_noise_axes(own, kScatterPlotAxes);
  std::vector<ScatterPlotImage> images;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, r.chosen}) {
    const SceneResult& s = r.results[k];
    images.push_back({s.name, project(principal, cube_of(*s.image)),
                      project(noise_fraction, cube_of(*s.image)), dominant_materials(*s.image)});
  }
  return scatter_plots(images, r.materials);
}

}  // namespace

std::string suburb_report(const SceneResults& r, ReportFigures& figures) {
  const SceneResult &ten = r.results[2], &ours = r.results[r.chosen];
  std::string maps = "<div class=\"row\">";
  for (std::size_t k : {std::size_t{3}, r.chosen}) maps += sample_map(r.results[k], figures);
  maps += "</div>\n";
  const std::string body =
      format(
          "<p>{} x {} pixels of a generated residential area, {} channels from {:.2f} to {:.2f} µm, without noise. "
          "{} How much of what lies inside the pixels does each way of sampling find, and what does it cost?</p>\n",
          ours.image->width(), ours.image->height(), r.wavelengths_um.size(), r.wavelengths_um.front(),
          r.wavelengths_um.back(), html_text(r.lighting)) +
      r.figures.html() + "<h2>The image (figure 8 of the paper)</h2>\n<div class=\"row\">" +
      radiance_map(r, r.results[0], 0.55, figures) + radiance_map(r, ours, 0.55, figures) +
      radiance_map(r, ours, 0.86, figures) + radiance_map(r, ours, 2.2, figures) +
      "</div>\n<h2>Samples, materials, time (table 2 of the paper)</h2>\n" + table_2(r) +
      format(
          "<p>Materials and abundances are held against labels on a lattice of 64 x 64 in every pixel; radiances "
          "against 64 x 64 rays a pixel in {:.0f} % of the pixels. Every ray is one path, whatever the sampling: the "
          "errors hold the noise of paths. A material counts from 0.1 % of a pixel's area. The adaptive scheme "
          "compares radiances at {:.2f} µm and allows {:.0f} %: two rays through one point differ by less in 95 % of "
          "pixels. The paper does not say what it compared.</p>\n",
          100.0 * r.reference_pixels, r.wavelengths_um[r.adaptive.channel],
          100.0 * r.adaptive.allowed_difference) +
      "<h2>Where the samples go (figure 12 of the paper)</h2>\n" + maps +
      "<h2>Error by wavelength</h2>\n<figure>" + rms_plot(r, figures) +
      format(
          "<figcaption>Accuracy sampling took {:.2f} times the time of the grid 10 x 10.</figcaption></figure>\n",
          ours.seconds / ten.seconds) +
      image_curves_report(r.curves, figures) +
      "<h2>All pixels in spectral space (figure 13 of the paper)</h2>\n" + scatter_plot(r) +
      "<p>Drag to turn, wheel to zoom; all panels turn together. The axes are those of the image by stated "
      "accuracy, their scale that of all images but the first, so that the panels can be compared; what lies beyond is "
      "drawn at the rim. With one ray a pixel nothing mixes and the clusters "
      "stand apart; as sampling grows finer the space between them fills with mixtures.</p>\n";
  return html_page("Sub-pixel content of a hyperspectral image", body);
}

}  // namespace ifov::studies
