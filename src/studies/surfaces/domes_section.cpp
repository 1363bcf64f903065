#include <algorithm>
#include <optional>

#include "core/format.h"
#include "studies/surfaces/dome_scene.h"
#include "studies/surfaces/surface_sections.h"

namespace ifov::studies {
namespace {

constexpr double kDomeReflectance = 0.8, kDomeSky = 30.0;
constexpr double kLeastWithin = 0.95, kMostDomeSamples = 200.0;

void add_domes(const std::string& name, const std::string& what, const JudgedDomes& judged,
               std::optional<double> most_samples, FigureTable& figures) {
  figures.at_least(name + "_within", static_cast<double>(judged.within) / judged.count, kLeastWithin, "",
                   format("{}: share of {} shifts within 1 %", what, judged.count));
  figures.at_most(name + "_wrong_and_sure", judged.wrong_and_sure, 0, "",
                  format("{}: shifts that are off by more than 3 % and converged", what));
  const std::string samples = format("{}: mean samples in the dome's pixel", what);
  if (most_samples)
    figures.at_most(name + "_samples", judged.samples, *most_samples, "samples", samples);
  else
    figures.report(name + "_samples", judged.samples, "samples", samples);
  figures.report(name + "_mean", judged.mean, "", format("{}: mean over the truth", what));
  figures.report(name + "_worst", judged.worst, "", format("{}: largest error", what));
  figures.report(name + "_held", static_cast<double>(judged.held) / judged.count, "",
                 format("{}: share within the half-width", what));
  figures.report(name + "_sure", static_cast<double>(judged.sure) / judged.count, "",
                 format("{}: share converged", what));
}

}  // namespace

ReportSection domes_section(const StudyOptions& options) {
  ReportSection section;
  section.title = "Domes smaller than a pixel";
  section.text =
      "A dome of 0.4 m in a pixel of 1 m, under the Sun, wherever it stands, at an accuracy of 1 %: nearly all light of the pixel comes "
      "from a spot of a few millimetres. Mirrors under a sky against rho (E R^2/4 + L pi R^2/2), metal of roughness 0.01 to 0.2 "
      "without sky against an integral over its disc.";
  const int shifts = std::max(1, options.trials);
  const io::MaterialDocument mirror = dome_mirror(kDomeReflectance);
  for (const bool disc : {true, false}) {
    const DomeLight light{disc, kDomeSky};
    add_domes(format("dome_mirror_{}", disc ? "disc" : "point"),
              format("mirror, Sun a {}", disc ? "disc" : "point"),
              judge_domes(mirror, light, mirror_dome_radiance(kDomeReflectance, light), shifts, options), {},
              section.figures);
  }
  Plot plot;
  plot.title = "Samples for a metal dome";
  plot.x_label = "roughness";
  plot.y_label = "mean samples in the pixel";
  plot.x_log = plot.y_log = true;
  plot.series = {{"Sun a disc", "#0072b2", {}, {}, false}, {"Sun a point", "#d55e00", {}, {}, false}};
  plot.levels = {{"asked", "#00703c", kMostDomeSamples, 0.0}};
  for (const double roughness : {0.01, 0.03, 0.05, 0.1, 0.2}) {
    const double truth = metal_dome_radiance(roughness);
    for (const bool disc : {true, false}) {
      const JudgedDomes judged = judge_domes(dome_metal(roughness), {disc, 0.0}, truth, shifts, options);
      add_domes(format("dome_metal_{:g}_{}", roughness, disc ? "disc" : "point"),
                format("metal {:g}, Sun a {}", roughness, disc ? "disc" : "point"), judged, kMostDomeSamples,
                section.figures);
      PlotSeries& series = plot.series[disc ? 0 : 1];
      series.x.push_back(roughness);
      series.y.push_back(judged.samples);
    }
  }
  section.plots.push_back({"dome_samples", plot, ""});
  return section;
}

}  // namespace ifov::studies
