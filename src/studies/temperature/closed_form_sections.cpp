#include <cmath>

#include "core/format.h"
#include "studies/temperature/temperature_checks.h"
#include "studies/temperature/temperature_sections.h"

namespace ifov::studies {

ReportSection conduction_section(const SectionOptions& options) {
  ReportSection section;
  section.title = "Conduction";
  section.text =
      "Concrete under a wave of flux, a step of flux, air that became warmer and a wave in moving air, against closed forms at the surface and at "
      "three depths; layers against the matrices of a wave (Carslaw and Jaeger 1959).";
  for (const double step_min : {5.0, 15.0}) {
    const double limit_k = step_min > 5.0 ? 0.2 : 0.1;
    for (int k = 0; k < kSlabCases; ++k) {
      const auto of = static_cast<SlabCase>(k);
      section.figures.at_most(format("{}_{:g}_min", name_of(of), step_min), slab_error_k(of, 60.0 * step_min),
                              limit_k, "K",
                              format("{}, steps of {:g} min: largest difference", name_of(of), step_min));
    }
    section.figures.at_most(format("layers_{:g}_min", step_min), layered_error_k(60.0 * step_min), limit_k,
                            "K",
                            format("a road of two layers and a wall of three, steps of {:g} min", step_min));
  }
  section.figures.at_least("order_cells", order_in_cells(), 1.9, "",
                           "order of the scheme in cells, halved three times: the lowest");
  section.figures.at_least("order_steps", order_in_steps(), 1.9, "",
                           "order of the scheme in steps, halved three times: the lowest");
  section.figures.at_least("fault_conductivity", slab_error_k(SlabCase::step_flux, 300.0, 1.02), 0.1, "K",
                           "planted fault: a solid that conducts 2 % better, step of flux");
  section.figures.at_least("fault_capacity", layered_error_k(300.0, 1.2), 0.1, "K",
                           "planted fault: a last layer that holds 20 % more heat");
  const char* meaning = "closed forms against the reference data";
  const auto file = options.reference.file("atmosphere/derived/thermal_analytic.csv");
  if (!file) {
    section.not_measured("closed_forms", meaning, "reference data");
  } else {
    const FileDifference found = closed_forms_off_file(*file);
    section.figures.at_most("closed_forms", found.rows > 0 ? found.worst_k : NAN, 1e-4, "K",
                            format("{}: {} rows", meaning, found.rows));
  }
  return section;
}

ReportSection balance_section(const SectionOptions&) {
  ReportSection section;
  section.title = "Balance of heat";
  section.text =
      "Plates without mass in the Sun and at night by their balance, the heat of four days, and DIRSIG's THERM slab against the same numbers in explicit "
      "steps of 0.25 s.";
  section.figures.between("plate_in_sun", steady_plate_k(900.0, 280.0, 10.0, 300.0), 347.203, 347.205, "K",
                          "plate in the Sun: 347.204 K");
  section.figures.between("plate_at_night", steady_plate_k(0.0, 230.0, 5.0, 285.0), 263.989, 263.991, "K",
                          "plate at night: 263.990 K");
  section.figures.at_least("fault_plate_sky", std::abs(steady_plate_k(0.0, 285.0, 5.0, 285.0) - 263.990),
                           0.001, "K", "planted fault: a sky as warm as the air");
  section.figures.at_most("heat_unaccounted", heat_unaccounted(), 1e-6, "",
                          "heat of four days that is not accounted for, dry and wet, over what came in");
  section.figures.at_most("therm", therm_error_k(), 0.05, "K",
                          "THERM's slab, one day: largest difference after the first hour");
  section.figures.at_least("fault_therm", therm_error_k(0.5), 0.05, "K",
                           "planted fault: one face in the air in place of three quarters of both");
  return section;
}

}  // namespace ifov::studies
