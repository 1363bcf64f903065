#include <algorithm>
#include <cmath>
#include <complex>

#include "core/format.h"
#include "io/document/cameras/frame_camera.h"
#include "io/document/document.h"
#include "io/document/shapes/flat_primitives.h"
#include "materials/bsdf/sea/sea.h"
#include "radiometry/fresnel.h"
#include "radiometry/refractive_index.h"
#include "studies/common/image_store.h"
#include "studies/common/study_document.h"
#include "studies/common/study_rendering.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kGlint_um = 0.55, kGlintIrradiance = 1000.0, kSalinity = 35.0;
constexpr double kSlopeMost = 0.02;

/// Tangent of the view's zenith angle that sees the Sun in the zenith mirrored by a facet of this slope.
double tangent_of_view(double slope) { return 2.0 * slope / (1.0 - slope * slope); }

}  // namespace

double cox_munk_slope(double wind_m_s) { return 0.003 + 0.00508 * wind_m_s; }

double slope_out_of_image(double wind_m_s, const StudyOptions& options, int pixels) {
  // Four standard deviations of the slope along the wind, and no view beyond 81 deg.
  const double last = std::min(0.85, 4.2 * std::sqrt(0.00316 * wind_m_s + 0.003)),
               half = tangent_of_view(last);
  io::FrameCamera camera;
  camera.focal_length_m = 0.02;
  camera.pitch_m = 2.0 * half * camera.focal_length_m / pixels;
  camera.size = {pixels, pixels};
  camera.position_m = {0.0, 0.0, 100.0};
  camera.orientation = io::LookAt{{0.0, 0.0, 0.0}, {}};
  io::Document document = nadir_document(
      {std::string(io::FrameCamera::kModel.key), std::make_shared<const io::FrameCamera>(camera), {}},
      "green", kGlint_um, grid_sampling(1), options.seed);
  const io::MaterialDocument sea =
      material_of({"sea",
                   "sea",
                   {format("wind={:g}", wind_m_s), "whitecaps=0", format("salinity={:g}", kSalinity)},
                   "0"});
  document.scene.materials = {sea};
  document.scene.objects = {object_of(io::PlanePrimitive(), sea.name)};
  io::SunDocument& sun = document.light.sun.emplace();
  sun.direction = io::CelestialDirection{0.0, 0.0};
  sun.irradiance.emplace().source = io::ConstantSpectrum{kGlintIrradiance};
  sun.irradiance->quantity = io::SpectrumOf::irradiance;
  ImageStore image;
  RenderChoices choices;
  choices.threads = options.threads;
  choices.cancel = options.cancel;
  render_document(study_text(document), options.output_folder, choices, image);

  const std::complex<double> index{materials::sea_water_index(kSalinity).at(kGlint_um),
                                   radiometry::refractive_index("water").k.at(kGlint_um)};
  double whole = 0.0, square = 0.0;
  for (int j = 0; j < pixels; ++j)
    for (int i = 0; i < pixels; ++i) {
      const double tangent =
          half * std::hypot(2.0 * (i + 0.5) / pixels - 1.0, 2.0 * (j + 0.5) / pixels - 1.0);
      const double view = std::atan(tangent), slope = std::tan(0.5 * view), tilt = std::cos(0.5 * view);
      if (slope > last) continue;
      const auto r = radiometry::fresnel_reflection_amplitudes(index, tilt);
      const double bsdf = static_cast<double>(image.mean()[image.index(i, j)]) / kGlintIrradiance;
      const double density =
          4.0 * std::cos(view) * std::pow(tilt, 4) * bsdf / (0.5 * (std::norm(r.p) + std::norm(r.s)));
      // Of slopes by that of tangents, each of the plane.
      const double area =
          tangent > 0.0 ? slope * (1.0 + slope * slope) / (2.0 * tangent * (1.0 + tangent * tangent)) : 0.25;
      whole += density * area;
      square += density * area * slope * slope;
    }
  return square / whole;
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
