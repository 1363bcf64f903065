#include <algorithm>
#include <cmath>

#include "core/format.h"
#include "studies/temperature/temperature_checks.h"
#include "studies/temperature/temperature_sections.h"

namespace ifov::studies {

ReportSection shadow_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Shadows that moved on";
  section.text =
      "Asphalt at 15 h where the shadow of a pole went by, and where a car stood from the morning on: means of estimates by rays, "
      "against one dimension solved in full with Sun and sky as the outline of pole and car, written out, hides them.";
  const PlacesOffK pole = pole_shadow(options.study);
  section.figures.at_most(
      "pole_path", pole.worst_k, 0.1, "K",
      format("15 places across the path of a pole's shadow, {:.1f} K apart: the worst", pole.range_k));
  for (const int left_min : {10, 30, 120}) {
    const CarTrace trace = car_trace(left_min, options.study);
    section.figures.at_most(format("car_left_{}_min", left_min), trace.worst_k, 0.1, "K",
                            format("a car that left {} min ago: the worst of three places", left_min));
    section.figures.at_least(format("fault_no_car_{}_min", left_min), trace.without_k, 0.1, "K",
                             "planted fault: as if none had stood there");
  }
  section.figures.at_most("closed_room", closed_room_drift_k(options.study), 1e-4, "K",
                          "second law: a closed room and what is in it, as warm as its air, after 10 days");
  return section;
}

ReportSection fault_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Planted faults";
  section.text =
      "The path of the pole's shadow (`pole_path`) once more, with classes solved under weather that is wrong: each must be off by more than the "
      "0.1 K of that row.";
  struct Planted {
    Fault fault;
    const char *name, *meaning;
  };
  for (const Planted& one :
       {Planted{Fault::no_diffuse_light, "fault_no_diffuse", "no light of the sky"},
        {Fault::wind_of_10_m, "fault_wind_of_10_m", "the wind at 10 m used at the ground"},
        {Fault::local_clock, "fault_local_clock", "a clock of UTC + 2 h taken for UTC"},
        {Fault::sky_as_air, "fault_sky_as_air", "a sky as warm as the air"},
        {Fault::other_yesterday, "fault_yesterday", "a day before of another weather (overcast)"}})
    section.figures.at_least(one.name, pole_shadow(options.study, one.fault).worst_k, 0.1, "K",
                             format("planted fault: {}", one.meaning));
  return section;
}

ReportSection height_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Wind by height";
  section.text =
      "Flat roofs of asphalt at 14 h, 4 to 50 m up, and the street: against one dimension in a wind that the logarithmic law has raised by hand, "
      "roughness length 0.03 m in the open and 1 m in a suburb.";
  Plot plot;
  plot.title = "Roofs by height";
  plot.x_label = "height, m";
  plot.y_label = "temperature, K";
  plot.x_log = true;
  for (const bool suburb : {false, true}) {
    const char* where = suburb ? "suburb" : "open";
    const RoofWind found = roof_wind(suburb, options.study);
    section.figures.at_most(format("roofs_{}", where), found.worst_k, 0.1, "K",
                            format("roofs and street, {}: the worst", where));
    section.figures.at_least(format("fault_roofs_{}", where), roof_wind(suburb, options.study, true).worst_k,
                             0.1, "K", "planted fault: the street's wind at all heights");
    section.figures.report(format("roof_cooler_{}", where), found.roof_k[0] - found.roof_k[4], "K",
                           "a roof 20 m up is cooler than the street by");
    plot.series.push_back({format("{}, by classes", where), suburb ? "#d55e00" : "#0072b2", found.height_m,
                           found.roof_k, true});
    plot.series.push_back({format("{}, solved alone", where), suburb ? "#d55e00" : "#0072b2", found.height_m,
                           found.expected_k, false});
  }
  section.plots.push_back({"heights", plot, "Asphalt in the Sun, a clear day of June, 2.5 m/s at 10 m."});
  return section;
}

ReportSection suburb_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Points of a suburb";
  const std::size_t an_hour = options.study.is_quick() ? 200 : 2500;
  section.text =
      "A suburb as `ifov make suburb` writes it, its opaque materials solved for by what their names say they are made of. Random points of roofs, walls, "
      "ground and cars at 5, 9, 14 and 20 h, each solved in full by itself from 512 rays to the Sun's past places and 256 to the sky, against its class "
      "with the same exposure; and what estimates by 10 rays are off on average. Walls and slopes turn from windward to leeward within some 30 degrees, which classes "
      "every 30 degrees smear: what that costs is seen beside weather that tells no wind direction.";
  const SuburbPoints found = suburb_points(an_hour, kSuburbHours, true, options.study);
  section.figures.at_most("suburb_rms", found.rms_k, 0.15, "K",
                          format("{} points: root mean square of the difference", found.points));
  section.figures.at_most("suburb_worst", found.worst_k, 1.0, "K", "the worst of them");
  section.figures.between("suburb_bias", found.bias_k, -0.02, 0.02, "K", "their mean");
  const double within_k = 0.02 + 3.0 * found.estimate_error_k;
  section.figures.between(
      "suburb_estimates", found.estimate_bias_k, -within_k, within_k, "K",
      format("mean difference of 16 estimates of each, 0.02 K beyond three standard errors of {:.4f} K",
             found.estimate_error_k));
  section.figures.between("suburb_covered", found.covered, 0.93, 0.995, "",
                          "share of points within the half-width that is measured of their material");
  section.figures.at_most("fault_suburb_covered", found.covered_by_half, 0.93, "",
                          "planted fault: within half of it");
  section.figures.at_least(
      "suburb_covered_by_image", found.covered_by_image, 0.93, "",
      "share within the half-width that is stated of the image, by the material that is off most");
  const double beside_within_k = 0.02 + 3.0 * found.beside_error_k;
  section.figures.at_most(
      "suburb_beside_rms", found.beside_rms_k, 0.15, "K",
      "every tenth of them with the surfaces about it as lit and shaded as they were, each solved in full");
  section.figures.between("suburb_beside_bias", found.beside_bias_k, -beside_within_k, beside_within_k, "K",
                          "their mean, beyond chance");
  section.figures.at_least("suburb_beside_covered", found.beside_covered, 0.93, "",
                           "share of them that half-widths hold");
  section.figures.at_least("fault_suburb_beside", found.without_beside_rms_k, 0.15, "K",
                           "a planted fault: what is about points taken for level ground as warm as the air");
  for (std::size_t hour = 0; hour < kSuburbHours.size(); ++hour)
    section.figures.report(format("suburb_half_width_{}", std::string(kSuburbHours[hour]).substr(0, 2)),
                           found.half_width_k[hour], "K",
                           format("half-width that is stated at {}", kSuburbHours[hour]));
  const SuburbPoints undirected =
      suburb_points(an_hour, std::span(kSuburbHours).subspan(2, 1), false, options.study);
  section.figures.at_most("undirected_rms", undirected.rms_k, 0.15, "K",
                          "at 14 h under weather that tells no wind direction: root mean square");
  section.figures.at_most("undirected_worst", undirected.worst_k, 1.0, "K", "the worst of them");
  section.figures.between("undirected_bias", undirected.bias_k, -0.02, 0.02, "K", "their mean");
  section.figures.report("undirected_half_width", undirected.half_width_k[0], "K",
                         "half-width that is stated there");
  Plot plot;
  plot.title = "Points of a suburb";
  plot.x_label = "solved in full, K";
  plot.y_label = "class less that, K";
  PlotSeries points{"a point", "#0072b2", {}, {}, true};
  const std::size_t every = std::max<std::size_t>(1, found.off_k.size() / 1500);
  for (std::size_t k = 0; k < found.off_k.size(); k += every)
    points.x.push_back(found.full_k[k]), points.y.push_back(found.off_k[k]);
  plot.series = {points};
  section.plots.push_back({"suburb", plot, "Differences of points of a suburb at four hours."});
  return section;
}

ReportSection query_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "What it costs";
  section.text = "Estimates of points of the suburb, by 14 or 15 rays each, on two threads.";
  const bool quick = options.study.is_quick();
  const QueryCost cost = query_cost(quick ? 50'000 : 1'000'000, options.study);
  const char* meaning = "a million estimates at 14 h, two threads";
  if (quick)
    section.figures.report("query_time", cost.seconds, "s", meaning);
  else
    section.figures.at_most("query_time", cost.seconds, 60.0, "s", meaning);
  section.figures.between("query_same", cost.same ? 1.0 : 0.0, 1.0, 1.0, "",
                          "the same to the last bit on 1, 2 and 7 threads (1: yes)");
  return section;
}

ReportSection unmeasured_section(const SectionOptions&) {
  return unmeasured_of(
      "temperatures",
      {{"exchange", "two plates, an L of squares, a cube: long-wave exchange through rays",
        "long-wave from other surfaces of the scene: what hides the sky is as warm as the air"},
       {"second_law_mirrors", "a closed scene of any materials, mirrors too: drift below 1e-4 K",
        "long-wave from other surfaces of the scene"},
       {"triangles", "51 million instanced triangles, 48 h: 20 s, 1 GiB, 3 times",
        "scene of that size here; `benchmarks/instances` has those"},
       {"times", "96 times of 512 x 512 pixels: a fifth of 96 runs", "run of many times"},
       {"same_products", "the same bytes of ranks, resumed runs and tiles",
        "run of that kind here; the tests of `tests/cli` do so"}});
}

}  // namespace ifov::studies
