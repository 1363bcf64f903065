#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "ifov/outcome.h"
#include "ifov/run_control.h"
#include "ifov/runs.h"
#include "ifov/simulation.h"

namespace ifov::python {

namespace nb = nanobind;

void add_outcomes(nb::module_& module) {
  nb::class_<Progress>(module, "Progress")
      .def_ro("pixels_done", &Progress::pixels_done)
      .def_ro("pixels_total", &Progress::pixels_total)
      .def_ro("pixels_converged", &Progress::pixels_converged)
      .def_ro("rays", &Progress::rays)
      .def_ro("worst_error_ratio", &Progress::worst_error_ratio)
      .def_ro("elapsed_s", &Progress::elapsed_s);

  nb::class_<Outcome>(module, "Outcome")
      .def_prop_ro("exit_code", &Outcome::exit_code)
      .def_prop_ro("converged", &Outcome::converged)
      .def_ro("folder", &Outcome::folder)
      .def_prop_ro("products",
                   [](const Outcome& outcome) {
                     std::vector<std::filesystem::path> paths;
                     for (const Product& product : outcome.products) paths.push_back(product.path);
                     return paths;
                   })
      .def_ro("totals", &Outcome::totals)
      .def_ro("accuracy_statement", &Outcome::accuracy_statement)
      .def_ro("warnings", &Outcome::warnings)
      .def_ro("tiles_done", &Outcome::tiles_done)
      .def_ro("tiles_left", &Outcome::tiles_left);

  nb::class_<Forecast>(module, "Forecast")
      .def_ro("rays", &Forecast::rays)
      .def_ro("elapsed_s", &Forecast::elapsed_s)
      .def_ro("processor_s", &Forecast::processor_s)
      .def_ro("uncertainty", &Forecast::uncertainty)
      .def_ro("memory_bytes", &Forecast::memory_bytes)
      .def_ro("disk_bytes", &Forecast::disk_bytes)
      .def_ro("product_bytes", &Forecast::product_bytes)
      .def_ro("probes", &Forecast::probes)
      .def_ro("probed_share", &Forecast::probed_share)
      .def_ro("probing_s", &Forecast::probing_s)
      .def_ro("shortages", &Forecast::shortages);

  nb::class_<RunStatus>(module, "RunStatus")
      .def_ro("complete", &RunStatus::complete)
      .def_ro("kept", &RunStatus::kept)
      .def_ro("document", &RunStatus::document)
      .def_ro("version", &RunStatus::version)
      .def_ro("seed", &RunStatus::seed)
      .def_ro("share_number", &RunStatus::share_number)
      .def_ro("share_count", &RunStatus::share_count)
      .def_ro("tiles_done", &RunStatus::tiles_done)
      .def_ro("tiles_wanted", &RunStatus::tiles_wanted)
      .def_ro("pixels_done", &RunStatus::pixels_done)
      .def_ro("pixels_wanted", &RunStatus::pixels_wanted)
      .def_ro("pixels_converged", &RunStatus::pixels_converged)
      .def_ro("rays", &RunStatus::rays)
      .def_ro("elapsed_s", &RunStatus::elapsed_s)
      .def_ro("worst_error_ratio", &RunStatus::worst_error_ratio)
      .def_ro("at_work", &RunStatus::at_work)
      .def_ro("text", &RunStatus::text);
}

}  // namespace ifov::python
