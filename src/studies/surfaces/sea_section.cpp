#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "studies/common/study_document.h"
#include "studies/surfaces/glint_slopes.h"
#include "studies/surfaces/surface_rendering.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kSlopeMost = 0.02;

/// Tangent of the view's zenith angle that sees the Sun in the zenith mirrored by a facet of this slope.
double tangent_of_view(double slope) { return 2.0 * slope / (1.0 - slope * slope); }

}  // namespace

double cox_munk_slope(double wind_m_s) { return 0.003 + 0.00508 * wind_m_s; }

double slope_out_of_image(double wind_m_s, const StudyOptions& options, int pixels) {
  // Four standard deviations of the slope along the wind, and no view beyond 81 deg.
  const double last = std::min(0.85, 4.2 * std::sqrt(0.00316 * wind_m_s + 0.003)),
               half = tangent_of_view(last);
  io::Document document = nadir_document(square_camera(pixels, half, {0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}),
                                         "green", glint::kWavelength_um, grid_sampling(1), options.seed);
  const io::MaterialDocument sea =
      material_of({"sea",
                   "sea",
                   {format("wind={:g}", wind_m_s), "whitecaps=0", format("salinity={:g}", glint::kSalinity)},
                   "0"});
  document.scene.materials = {sea};
  document.scene.objects = {object_of(io::PlanePrimitive(), sea.name)};
  io::SunDocument& sun = document.light.sun.emplace();
  sun.direction = io::CelestialDirection{0.0, 0.0};
  sun.irradiance.emplace().source = io::ConstantSpectrum{glint::kIrradiance_w_m2_um};
  sun.irradiance->quantity = io::SpectrumOf::irradiance;
  const SurfaceImage image = render_surface(document, options);

  return slope_of_glint(image.radiance, pixels, half, last);
}

ReportSection sea_section(const StudyOptions& options) {
  ReportSection section;
  section.title = "The sea's slopes";
  section.text =
      "As Cox and Munk found them in photographs of 1951: from the radiance of the Sun's glint, rendered, back to the density of slopes, "
      "and from there to their mean square. Against their 0.003 + 0.00508 U, within 2 %.";
  Plot plot;
  plot.title = "Mean-square slope of the sea";
  plot.x_label = "wind, m/s";
  plot.y_label = "mean-square slope";
  PlotSeries line{"Cox and Munk", "#0072b2", {}, {}, false},
      found{"out of the image", "#d55e00", {}, {}, true};
  for (const double wind : {2.0, 5.0, 10.0, 15.0}) {
    const double slope = slope_out_of_image(wind, options, options.is_quick() ? 160 : 400);
    line.x.push_back(wind);
    line.y.push_back(cox_munk_slope(wind));
    found.x.push_back(wind);
    found.y.push_back(slope);
    section.figures.between(
        format("sea_slope_{:g}", wind), slope / cox_munk_slope(wind), 1.0 - kSlopeMost, 1.0 + kSlopeMost, "",
        format("mean-square slope out of the glint at {:g} m/s over Cox and Munk's", wind));
  }
  plot.series = {line, found};
  section.plots.push_back({"sea_slopes", plot, ""});
  return section;
}

}  // namespace ifov::studies
