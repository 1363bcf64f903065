#include "ifov/runs.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "call.h"
#include "ifov/detect.h"
#include "ifov/products.h"

namespace ifov::python {

namespace {

DetectedQuantity detected_quantity(const std::string& name) {
  if (name == "radiance") return DetectedQuantity::radiance;
  if (name == "electrons") return DetectedQuantity::electrons;
  if (name == "counts") return DetectedQuantity::counts;
  if (name == "kelvins") return DetectedQuantity::kelvins;
  if (name == "toa_reflectance") return DetectedQuantity::toa_reflectance;
  throw nb::value_error(("quantities: found '" + name +
                         "', expected 'radiance', 'kelvins', 'toa_reflectance', 'electrons' or 'counts'")
                            .c_str());
}

}  // namespace

void add_runs(nb::module_& module) {
  module.def("run_status", &run_status, nb::arg("folder"));
  module.def(
      "merge",
      [](const std::vector<std::filesystem::path>& folders, const std::filesystem::path& output, bool partial,
         int threads, nb::object log) {
        Call call(nb::none(), std::move(log));
        return call.run([&] {
          return merge(folders,
                       {.output_folder = output, .threads = threads, .partial = partial, .log = &call});
        });
      },
      nb::arg("folders"), nb::arg("output"), nb::arg("partial"), nb::arg("threads"), nb::arg("log").none());

  module.def(
      "detect",
      [](const std::filesystem::path& run, const std::filesystem::path& folder, std::uint64_t seed, int count,
         const std::vector<std::string>& quantities, const std::optional<Document>& other,
         const std::vector<std::string>& set, int threads, const std::vector<std::filesystem::path>& after) {
        std::vector<DetectedQuantity> wanted;
        for (const std::string& name : quantities) wanted.push_back(detected_quantity(name));
        Call call;
        const Detection detection = call.run([&] {
          return detect(run, {.folder = folder,
                              .first_seed = seed,
                              .realizations = count,
                              .quantities = wanted,
                              .other = other,
                              .set = set,
                              .threads = threads,
                              .cancel = call.cancel(),
                              .after = after});
        });
        nb::dict noise;
        for (const Detection::Channel& channel : detection.channels)
          noise[channel.name.c_str()] = channel.noise;
        return nb::make_tuple(noise, detection.cubes);
      },
      nb::arg("run"), nb::arg("folder"), nb::arg("seed"), nb::arg("count"), nb::arg("quantities"),
      nb::arg("other").none(), nb::arg("set"), nb::arg("threads"), nb::arg("after"));

  nb::class_<RegionMean::Channel>(module, "RegionChannel")
      .def_ro("name", &RegionMean::Channel::name)
      .def_ro("pixels", &RegionMean::Channel::pixels)
      .def_ro("mean", &RegionMean::Channel::mean)
      .def_ro("half_width", &RegionMean::Channel::half_width);
  nb::class_<RegionMean>(module, "RegionMean")
      .def_ro("region", &RegionMean::region)
      .def_ro("pixels", &RegionMean::pixels)
      .def_ro("converged", &RegionMean::converged)
      .def_ro("reasons", &RegionMean::reasons)
      .def_ro("channels", &RegionMean::channels);
  module.def("region_means", &region_means, nb::arg("products"), nb::arg("regions"));
}

}  // namespace ifov::python
