#include "ifov/assets.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "bindings.h"

namespace ifov::python {
namespace {

namespace nb = nanobind;

template <class Value, int kColumns>
using Rows = nb::ndarray<const Value, nb::shape<-1, kColumns>, nb::c_contig, nb::device::cpu>;
template <class Value>
using List = nb::ndarray<const Value, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <class Value, std::size_t kColumns, class Array>
std::vector<std::array<Value, kColumns>> rows_of(const Array& array) {
  std::vector<std::array<Value, kColumns>> result(array.shape(0));
  if (!result.empty()) std::copy_n(array.data(), array.size(), result.front().data());
  return result;
}

template <class Value, class Array>
std::vector<Value> list_of(const Array& array) {
  return {array.data(), array.data() + array.size()};
}

template <class Value>
std::vector<Value> list_of(const std::optional<List<Value>>& array) {
  return array ? list_of<Value>(*array) : std::vector<Value>();
}

}  // namespace

void add_assets(nb::module_& module) {
  nb::class_<Assets>(module, "Assets")
      .def(nb::init<>())
      .def(
          "add_mesh",
          [](Assets& assets, const std::string& name, const Rows<double, 3>& vertices,
             const Rows<std::uint32_t, 3>& triangles, const std::optional<Rows<double, 3>>& normals,
             const std::optional<Rows<double, 2>>& uv, const std::optional<List<std::uint32_t>>& materials,
             std::vector<std::string> material_names) {
            MeshAsset mesh{.vertices = rows_of<double, 3>(vertices),
                           .triangles = rows_of<std::uint32_t, 3>(triangles),
                           .normals = {},
                           .uv = {},
                           .materials = list_of<std::uint32_t>(materials),
                           .material_names = std::move(material_names)};
            if (normals) mesh.normals = rows_of<double, 3>(*normals);
            if (uv) mesh.uv = rows_of<double, 2>(*uv);
            assets.add(name, mesh);
          },
          nb::arg("name"), nb::arg("vertices"), nb::arg("triangles"), nb::arg("normals").none(),
          nb::arg("uv").none(), nb::arg("materials").none(), nb::arg("material_names"))
      .def(
          "add_raster",
          [](Assets& assets, const std::string& name,
             const nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>& values,
             const std::optional<std::array<double, 6>>& geotransform, std::string crs,
             std::optional<double> nodata, std::vector<std::string> units) {
            RasterAsset raster;
            raster.bands = static_cast<int>(values.shape(0));
            raster.height = static_cast<int>(values.shape(1));
            raster.width = static_cast<int>(values.shape(2));
            raster.values.assign(values.data(), values.data() + values.size());
            raster.geotransform = geotransform;
            raster.crs = std::move(crs);
            raster.nodata = nodata;
            raster.units = std::move(units);
            assets.add(name, raster);
          },
          nb::arg("name"), nb::arg("values"), nb::arg("geotransform").none(), nb::arg("crs"),
          nb::arg("nodata").none(), nb::arg("units"))
      .def("add_spectrum",
           [](Assets& assets, const std::string& name, const List<double>& wavelengths,
              const List<double>& values) {
             assets.add(name, SpectrumAsset{list_of<double>(wavelengths), list_of<double>(values)});
           })
      .def(
          "add_copies",
          [](Assets& assets, const std::string& name, const Rows<double, 3>& positions,
             const std::optional<List<double>>& yaw, const std::optional<List<double>>& scale) {
            assets.add(name, CopiesAsset{rows_of<double, 3>(positions), list_of<double>(yaw),
                                         list_of<double>(scale)});
          },
          nb::arg("name"), nb::arg("positions"), nb::arg("yaw").none(), nb::arg("scale").none())
      .def("add_file",
           [](Assets& assets, const std::string& name, const nb::bytes& bytes) {
             assets.add(name, FileAsset{std::string(bytes.c_str(), bytes.size())});
           })
      .def_prop_ro("names", &Assets::names);
}

}  // namespace ifov::python
