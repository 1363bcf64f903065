#include <cmath>
#include <numbers>
#include <vector>

#include "materials/bsdf/rough_conductor.h"
#include "materials/bsdf_checks.h"
#include "math/angle.h"
#include "radiometry/fresnel.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kGlass = 1.5;

/// Degree of linear polarization of unpolarized light that a smooth surface reflects.
double degree_of_fresnel(double incidence_rad) {
  const auto r = radiometry::fresnel_reflection_amplitudes(kGlass, std::cos(incidence_rad));
  const double p = std::norm(r.p), s = std::norm(r.s);
  return std::abs(s - p) / (s + p);
}

/// The same where a facet mirrors, of the model with facets that lean by next to nothing.
double degree_of_facets(double incidence_rad) {
  const materials::RoughConductor glass(
      radiometry::Spectrum::constant(kGlass), radiometry::Spectrum::constant(0.0),
      radiometry::Spectrum::constant(1.0), {materials::FacetShape::beckmann, 0.002, 0.002, 0.0});
  std::vector<float> values;
  for (const radiometry::Spectrum& spectrum : glass.spectra())
    values.push_back(static_cast<float>(spectrum.at(1.0)));
  for (const radiometry::Spectrum& spectrum : glass.polarization_spectra())
    values.push_back(static_cast<float>(spectrum.at(1.0)));
  std::vector<const float*> rows;
  for (const float& value : values) rows.push_back(&value);
  materials::BsdfEvent event = materials::view_of({std::sin(incidence_rad), 0.0, std::cos(incidence_rad)});
  event.incoming = {-event.outgoing.x, 0.0, event.outgoing.z};
  float stokes[16] = {};
  glass.evaluate_mueller(event, rows, 1, {stokes, 1, false});
  return std::hypot(static_cast<double>(stokes[1]), static_cast<double>(stokes[2])) /
         static_cast<double>(stokes[0]);
}

/// Where a function that has one greatest value between two angles has it, by thirds.
double angle_of_greatest(double (*value)(double), double low, double high) {
  for (int k = 0; k < 100; ++k) {
    const double third = (high - low) / 3.0;
    (value(low + third) < value(high - third) ? low : high) +=
        value(low + third) < value(high - third) ? third : -third;
  }
  return 0.5 * (low + high);
}

}  // namespace

ReportSection fresnel_section(const StudyOptions&) {
  ReportSection section;
  section.title = "Fresnel";
  section.text =
      "Unpolarized light that a surface of index 1.5 reflects: its degree of linear polarization at 45 deg, and the "
      "angle at which it is 1, Brewster's, arctan 1.5. By Fresnel's equations, and by facets that lean by next to "
      "nothing.";
  const double at_45 = 45.0 * math::kDegree;
  section.figures.between("dolp_45", degree_of_fresnel(at_45), 0.83147, 0.83149, "",
                          "degree of linear polarization at 45 deg");
  section.figures.between("dolp_45_facets", degree_of_facets(at_45), 0.8313, 0.8317, "",
                          "the same of rough_conductor, n = 1.5");
  section.figures.between("brewster", angle_of_greatest(degree_of_fresnel, 0.8, 1.2) / math::kDegree, 56.3094,
                          56.3104, "deg", "Brewster's angle");
  section.figures.between("brewster_facets", angle_of_greatest(degree_of_facets, 0.8, 1.2) / math::kDegree,
                          56.3, 56.32, "deg", "the same of rough_conductor");
  Plot plot;
  plot.title = "Polarization by reflection, n = 1.5";
  plot.x_label = "angle of incidence, deg";
  plot.y_label = "degree of linear polarization";
  PlotSeries fresnel{"Fresnel", "#0072b2", {}, {}, false}, facets{"rough_conductor", "#d55e00", {}, {}, true};
  for (int deg = 0; deg <= 89; ++deg) {
    fresnel.x.push_back(deg);
    fresnel.y.push_back(degree_of_fresnel(deg * math::kDegree));
    if (deg % 5 != 0) continue;
    facets.x.push_back(deg);
    facets.y.push_back(degree_of_facets(deg * math::kDegree));
  }
  plot.series = {fresnel, facets};
  section.plots.push_back({"polarization", plot, ""});
  return section;
}

}  // namespace ifov::studies
