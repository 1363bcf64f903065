#pragma once

#include <nanobind/nanobind.h>

namespace ifov::python {

// What each concept adds to the module.
void add_documents(nanobind::module_& module);
void add_assets(nanobind::module_& module);
void add_outcomes(nanobind::module_& module);
void add_simulation(nanobind::module_& module);
void add_runs(nanobind::module_& module);
void add_atmosphere(nanobind::module_& module);
void add_materials(nanobind::module_& module);
void add_sensors(nanobind::module_& module);
void add_sampling(nanobind::module_& module);

}  // namespace ifov::python
