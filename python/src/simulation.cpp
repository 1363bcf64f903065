#include "ifov/simulation.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "bindings.h"
#include "call.h"
#include "image_arrays.h"

namespace ifov::python {
namespace {

using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// So many seconds from now.
Deadline deadline(std::optional<double> seconds) {
  if (!seconds) return {};
  return std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                std::chrono::duration<double>(*seconds));
}

std::span<const std::array<double, 3>> triples(const Points& points) {
  return {reinterpret_cast<const std::array<double, 3>*>(points.data()), points.shape(0)};
}

/// A list of values as an array that owns them.
template <class Value>
nb::object array_of(std::vector<Value> values, std::initializer_list<std::size_t> shape) {
  auto* const kept = new std::vector<Value>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<Value>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, Value>(kept->data(), shape, owner));
}

nb::dict cast_rays(const Simulation& simulation, const Points& origins, const Points& directions,
                   int threads) {
  Call call;
  const std::vector<RayHit> hits =
      call.run([&] { return simulation.cast(triples(origins), triples(directions), threads); });
  const std::size_t count = hits.size();
  std::vector<std::uint8_t> hit(count);
  std::vector<double> distance(count), position(3 * count), normal(3 * count), uv(2 * count);
  std::vector<std::int32_t> object(count);
  nb::list material;
  for (std::size_t k = 0; k < count; ++k) {
    const RayHit& one = hits[k];
    hit[k] = one.hit ? 1 : 0;
    distance[k] = one.distance_m;
    std::copy_n(one.position_m.data(), 3, &position[3 * k]);
    std::copy_n(one.normal.data(), 3, &normal[3 * k]);
    uv[2 * k] = one.u, uv[2 * k + 1] = one.v;
    object[k] = one.object;
    material.append(one.material);
  }
  nb::dict all;
  all["hit"] = array_of(std::move(hit), {count});
  all["distance"] = array_of(std::move(distance), {count});
  all["position"] = array_of(std::move(position), {count, 3});
  all["normal"] = array_of(std::move(normal), {count, 3});
  all["uv"] = array_of(std::move(uv), {count, 2});
  all["object"] = array_of(std::move(object), {count});
  all["material"] = material;
  return all;
}

/// (description of the image, arrays, outcome)
nb::tuple render_tiles(const Simulation& simulation, int threads, const Document* sampling,
                       std::optional<double> time_limit_s, std::vector<std::string> quantities,
                       nb::object progress, nb::object on_tile) {
  Call call(std::move(progress));
  ImageArrays arrays(call, std::move(on_tile));
  const Outcome outcome = call.run([&] {
    return simulation.render_tiles(arrays, {.threads = threads,
                                            .sampling = sampling,
                                            .deadline = deadline(time_limit_s),
                                            .quantities = std::move(quantities),
                                            .cancel = call.cancel(),
                                            .progress = &call});
  });
  return nb::make_tuple(described(arrays.image()), arrays.arrays(), outcome);
}

RenderOptions run_options(const std::filesystem::path& folder, int threads, const std::string& start,
                          bool keep, bool refine, bool anyway, std::pair<int, int> share,
                          std::optional<double> time_limit_s) {
  RenderOptions options;
  options.folder = folder;
  options.threads = threads;
  options.start = start == "resume"    ? RunStart::resume
                  : start == "restart" ? RunStart::restart
                                       : RunStart::fresh;
  options.keep = keep;
  options.refine = refine;
  options.anyway = anyway;
  options.share = {share.first, share.second};
  options.deadline = deadline(time_limit_s);
  return options;
}

}  // namespace

void add_simulation(nb::module_& module) {
  nb::class_<Simulation>(module, "Simulation")
      .def_prop_ro("image", [](const Simulation& simulation) { return described(simulation.image()); })
      .def_prop_ro("description", &Simulation::description)
      .def_prop_ro("warnings", [](const Simulation& simulation) { return simulation.warnings(); })
      .def("cast", &cast_rays, nb::arg("origins"), nb::arg("directions"), nb::arg("threads") = 0)
      .def("render_tiles", &render_tiles, nb::arg("threads"), nb::arg("sampling").none(),
           nb::arg("time_limit").none(), nb::arg("quantities"), nb::arg("progress").none(),
           nb::arg("on_tile").none())
      .def(
          "render",
          [](const Simulation& simulation, const std::filesystem::path& folder, int threads,
             const std::string& start, bool keep, bool refine, bool anyway, std::pair<int, int> share,
             std::optional<double> time_limit_s, nb::object progress, nb::object log) {
            Call call(std::move(progress), std::move(log));
            RenderOptions options =
                run_options(folder, threads, start, keep, refine, anyway, share, time_limit_s);
            options.cancel = call.cancel();
            options.progress = &call;
            options.log = &call;
            return call.run([&] { return simulation.render(options); });
          },
          nb::arg("folder"), nb::arg("threads"), nb::arg("start"), nb::arg("keep"), nb::arg("refine"),
          nb::arg("anyway"), nb::arg("share"), nb::arg("time_limit").none(), nb::arg("progress").none(),
          nb::arg("log").none())
      .def(
          "forecast",
          [](const Simulation& simulation, const std::filesystem::path& folder, int threads, bool keep) {
            Call call;
            RenderOptions options;
            options.folder = folder;
            options.threads = threads;
            options.keep = keep;
            options.cancel = call.cancel();
            return call.run([&] { return simulation.forecast(options); });
          },
          nb::arg("folder"), nb::arg("threads"), nb::arg("keep"));
  module.def(
      "load",
      [](const Document& document, bool scene_cache, int threads, nb::object progress, nb::object log) {
        Call call(std::move(progress), std::move(log));
        return call.run([&] {
          return Simulation::load(document, {.scene_cache = scene_cache,
                                             .threads = threads,
                                             .cancel = call.cancel(),
                                             .progress = &call,
                                             .log = &call});
        });
      },
      nb::arg("document"), nb::arg("scene_cache"), nb::arg("threads"), nb::arg("progress").none(),
      nb::arg("log").none());
}

}  // namespace ifov::python
