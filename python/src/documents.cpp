#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "call.h"
#include "ifov/check.h"
#include "ifov/document.h"

namespace ifov::python {

void add_documents(nb::module_& module) {
  nb::class_<Document>(module, "Document")
      .def("with_assets", &Document::with_assets)
      .def_prop_ro("name", &Document::name)
      .def_prop_ro("output_folder", &Document::output_folder);
  module.def("parse", &Document::parse, nb::arg("text"), nb::arg("name"), nb::arg("folder"),
             nb::arg("set") = std::vector<std::string>());
  module.def("schema", &document_schema);

  nb::enum_<Severity>(module, "Severity")
      .value("statement", Severity::statement)
      .value("warning", Severity::warning)
      .value("error", Severity::error)
      .value("failure", Severity::failure);
  nb::class_<Message>(module, "Message")
      .def_ro("severity", &Message::severity)
      .def_ro("text", &Message::text)
      .def_prop_ro("file", [](const Message& message) { return message.position.file; })
      .def_prop_ro("line", [](const Message& message) { return message.position.line; })
      .def_prop_ro("column", [](const Message& message) { return message.position.column; });
  module.def(
      "check",
      [](const Document& document, int threads, nb::object progress) {
        Call call(std::move(progress));
        return call.run([&] {
          return check(document, {.threads = threads, .cancel = call.cancel(), .progress = &call});
        });
      },
      nb::arg("document"), nb::arg("threads") = 0, nb::arg("progress") = nb::none());
}

}  // namespace ifov::python
