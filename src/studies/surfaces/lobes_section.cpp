#include <algorithm>
#include <numbers>
#include <string>

#include "core/format.h"
#include "io/document/document.h"
#include "session/surveys/brdf_survey.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kLobeLight_deg = 40.0;
constexpr const char* kLobeColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                        "#e69f00", "#56b4e9", "#000000"};

struct LobePlot {
  const char *name, *what;
  bool logarithmic;
  std::vector<StudySurface> surfaces;
};

std::vector<LobePlot> lobe_plots() {
  return {{"land",
           "land",
           false,
           {{"lambertian 0.3", "lambertian", {}, "0.3"},
            {"oren_nayar, 25 deg", "oren_nayar", {"slope=25 deg"}, "0.35"},
            {"ross_li", "ross_li", {"f_vol=0.15", "f_geo=0.02", "hot_spot=1.5 deg"}, "0.3"},
            {"roujean", "roujean", {"k1=0.03", "k2=0.5"}, "0.3"},
            {"rpv, k = 0.7", "rpv", {"k=0.7", "asymmetry=-0.15"}, "0.13"},
            {"hapke, 20 deg", "hapke", {"b0=0.5", "roughness=20 deg"}, "0.75"}}},
          {"facets",
           "surfaces of facets",
           true,
           {{"rough_conductor 0.1, aluminium", "rough_conductor", {"index=aluminium", "roughness=0.1"}, "1"},
            {"rough_conductor 0.4, aluminium", "rough_conductor", {"index=aluminium", "roughness=0.4"}, "1"},
            {"rough_dielectric 0.15", "rough_dielectric", {"roughness=0.15"}, "0.3"},
            {"ward 0.2", "ward", {"specular=0.1", "roughness=0.2"}, "0.3"},
            {"sea, 5 m/s", "sea", {"wind=5"}, "0.02"}}}};
}

}  // namespace

io::MaterialDocument material_of(const StudySurface& surface) {
  io::MaterialDocument material =
      session::document_of_model(surface.model, surface.parameters, surface.reflectance)
          .scene.materials.front();
  material.name = "surface";
  return material;
}

ReportSection lobes_section(const StudyOptions&) {
  ReportSection section;
  section.title = "Lobes and reflectance";
  section.text = format(
      "BRDF in the plane of the normal and the light, which comes from {:g} deg (views above 0 are on its side), and "
      "directional-hemispherical reflectance by the angle of the light, at 0.55 um.",
      kLobeLight_deg);
  BrdfQuestion question;
  question.wavelength_um = 0.55;
  question.light_rad = {kLobeLight_deg * std::numbers::pi / 180.0};
  double most = 0.0;
  for (const LobePlot& kind : lobe_plots()) {
    Plot lobes, shares;
    lobes.title = format("Lobes of {}", kind.what);
    lobes.x_label = "zenith angle of the view, deg";
    lobes.y_label = "BRDF, 1/sr";
    lobes.y_log = kind.logarithmic;
    shares.title = format("Reflectance of {}", kind.what);
    shares.x_label = "zenith angle of the light, deg";
    shares.y_label = "directional-hemispherical reflectance";
    int k = 0;
    for (const StudySurface& surface : kind.surfaces) {
      const io::Document document =
          session::document_of_model(surface.model, surface.parameters, surface.reflectance);
      const io::BrdfReport report = session::survey_brdf(document, surface.model, question);
      PlotSeries lobe{surface.label, kLobeColours[k], {}, {}, false}, share = lobe;
      for (std::size_t i = 0; i < report.view_rad.size(); ++i) {
        const double view_deg = report.view_rad[i] * 180.0 / std::numbers::pi;
        if (std::abs(view_deg) > 80.0) continue;
        lobe.x.push_back(view_deg);
        lobe.y.push_back(report.lobes.front().brdf[i]);
      }
      for (std::size_t i = 0; i < report.zenith_rad.size(); ++i) {
        most = std::max(most, report.reflectance[i]);
        share.x.push_back(report.zenith_rad[i] * 180.0 / std::numbers::pi);
        share.y.push_back(report.reflectance[i]);
      }
      lobes.series.push_back(lobe);
      shares.series.push_back(share);
      ++k;
    }
    section.plots.push_back({format("lobes_{}", kind.name), lobes, ""});
    section.plots.push_back({format("reflectance_{}", kind.name), shares, ""});
  }
  section.figures.at_most("largest_reflectance", most, 1.001, "",
                          "largest directional-hemispherical reflectance of the surfaces drawn");
  return section;
}

}  // namespace ifov::studies
