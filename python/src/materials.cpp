#include "ifov/materials.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"

namespace ifov::python {

namespace nb = nanobind;

void add_materials(nb::module_& module) {
  nb::class_<Material::Curve>(module, "Curve")
      .def_ro("name", &Material::Curve::name)
      .def_ro("sample", &Material::Curve::sample)
      .def_ro("origins", &Material::Curve::origins)
      .def_ro("modelled", &Material::Curve::modelled)
      .def_ro("wavelength", &Material::Curve::wavelength_um)
      .def_ro("reflectance", &Material::Curve::reflectance)
      .def_ro("transmittance", &Material::Curve::transmittance)
      .def_ro("emissivity", &Material::Curve::emissivity);
  nb::class_<Material>(module, "Material")
      .def_ro("name", &Material::name)
      .def_ro("group", &Material::group)
      .def_ro("about", &Material::about)
      .def_ro("words", &Material::words)
      .def_ro("curves", &Material::curves);
  module.def("search_materials", &search_materials, nb::arg("text"));
}

}  // namespace ifov::python
