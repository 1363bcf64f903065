// The extension module: libifov's facade (include/ifov) for the Python of ../ifov, one source a concept. It is no interface for
// users: what it is given was made by that Python, and has its types.
#include <nanobind/stl/string.h>

#include "bindings.h"
#include "ifov/error.h"
#include "ifov/version.h"

namespace {

/// The classes are Python's, so that they are there without this module.
void raise(const char* name, const nanobind::tuple& arguments) {
  const nanobind::object type = nanobind::module_::import_("ifov._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

}  // namespace

NB_MODULE(_ifov, module) {
  namespace nb = nanobind;
  nb::set_leak_warnings(false);  // modules keep types until the process ends
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const ifov::InputError& error) {
      const ifov::SourcePosition& at = error.position();
      raise("DocumentError", nb::make_tuple(error.what(), at.file, at.line, at.column));
    } catch (const ifov::SystemError& error) {
      raise("SystemError", nb::make_tuple(error.what()));
    } catch (const ifov::Cancelled& stopped) {  // from elsewhere: run.part/stop
      PyErr_SetString(PyExc_KeyboardInterrupt, stopped.what());
    }
  });
  module.def("version", &ifov::version);
  ifov::python::add_documents(module);
  ifov::python::add_assets(module);
  ifov::python::add_outcomes(module);
  ifov::python::add_simulation(module);
  ifov::python::add_runs(module);
  ifov::python::add_atmosphere(module);
  ifov::python::add_materials(module);
  ifov::python::add_sensors(module);
  ifov::python::add_sampling(module);
}
