#include "ifov/sampling.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "bindings.h"

namespace ifov::python {

namespace nb = nanobind;

namespace {

template <class Value>
using Numbers = nb::ndarray<const Value, nb::c_contig, nb::device::cpu>;

/// What is given lives as long as the call: the Python of this package copies what it keeps.
nb::object lent(std::span<const double> values, std::size_t columns) {
  const std::size_t shape[2] = {columns == 0 ? 0 : values.size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, const double, nb::ndim<2>>(values.data(), 2, shape, nb::handle()),
                  nb::rv_policy::copy);
}

template <class Value>
void take(const nb::handle& given, std::span<Value> values) {
  const auto array = nb::cast<Numbers<Value>>(given);
  if (array.size() != values.size())
    throw nb::value_error("field: the answer has another size than was asked for");
  std::copy_n(array.data(), array.size(), values.data());
}

/// Functions of ifov/sampling.py: labels(x, y), values(x, y, random) -> (labels, values), with arrays of one column and more.
class PythonField final : public FieldFunction {
 public:
  PythonField(int columns, int random, nb::object labels, nb::object values)
      : columns_(columns), random_(random), labels_(std::move(labels)), values_(std::move(values)) {}
  int columns() const override { return columns_; }
  int random_numbers() const override { return random_; }

  void labels(std::span<const double> x, std::span<const double> y,
              std::span<std::uint64_t> labels) override {
    look_for_signals();
    take(labels_(lent(x, 1), lent(y, 1)), labels);
  }

  void values(std::span<const double> x, std::span<const double> y, std::span<const double> random,
              std::span<std::uint64_t> labels, std::span<double> values) override {
    look_for_signals();
    const nb::object told = values_(lent(x, 1), lent(y, 1), lent(random, std::size_t(random_)));
    take(told[0], labels);
    take(told[1], values);
  }

 private:
  static void look_for_signals() {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }

  int columns_, random_;
  nb::object labels_, values_;
};

template <class Value>
nb::object array_of(const std::vector<Value>& values, std::initializer_list<std::size_t> shape) {
  return nb::cast(
      nb::ndarray<nb::numpy, const Value>(values.data(), shape.size(), shape.begin(), nb::handle()),
      nb::rv_policy::copy);
}

}  // namespace

void add_sampling(nb::module_& module) {
  module.def("integrate", [](int columns, int random, nb::object labels, nb::object values, int width,
                             int height, double error, bool relative, double floor, double confidence,
                             std::uint64_t seed, std::uint32_t max_samples, int lattice) {
    PythonField field(columns, random, std::move(labels), std::move(values));
    const IntegratedImage image = integrate(field, width, height,
                                            {.error = error,
                                             .relative = relative,
                                             .floor = floor,
                                             .confidence = confidence,
                                             .seed = seed,
                                             .max_samples = max_samples,
                                             .lattice = lattice});
    const auto rows = std::size_t(image.height), across = std::size_t(image.width),
               bands = std::size_t(image.columns);
    nb::dict made;
    made["mean"] = array_of(image.mean, {rows, across, bands});
    made["half_width"] = array_of(image.half_width, {rows, across, bands});
    made["samples"] = array_of(image.samples, {rows, across});
    made["reasons"] = array_of(image.reasons, {rows, across});
    made["missable_fraction"] = array_of(image.missable_fraction, {rows, across});
    return made;
  });
}

}  // namespace ifov::python
