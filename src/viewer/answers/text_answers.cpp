#include "core/error.h"
#include "ifov/materials.h"
#include "io/json/json_writer.h"
#include "viewer/answers/answers.h"
#include "viewer/sources/checked_document.h"
#include "viewer/sources/open_run.h"
#include "viewer/sources/scene_source.h"

namespace ifov::viewer {
namespace {

const char* severity_name(Severity severity) {
  switch (severity) {
    case Severity::statement: return "statement";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
    case Severity::failure: return "failure";
  }
  return "statement";
}

constexpr std::size_t kMostMaterials = 60;

}  // namespace

Answer Answers::document(const Query& query) {
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  if (document_) {
    document_version();
    // Not both at a time: each loads what the document names, and the second finds what the first has left in the cache.
    if (scene_ == nullptr || !scene_->is_loading()) document_->begin();
    const CheckedDocument::State state = document_->state();
    json.object([&] {
      json.member("version", state.version);
      json.member("file", state.file);
      json.member("text", state.text);
      json.member("checked", state.checked);
      json.list("messages", [&] {
        for (const Message& message : state.messages)
          json.object([&] {
            json.member("severity", severity_name(message.severity));
            json.member("text", message.text);
            json.member("file", message.position.file);
            json.member("line", message.position.line);
            json.member("column", message.position.column);
          });
      });
    });
    return {.body = json.written()};
  }
  const auto run = source(query).now().run;
  if (!run || run->record.empty()) throw Refused(404, "there is no run record that holds a document");
  json.object([&] {
    json.member("version", 1);
    json.member("file", run->document);
    json.member("text", run->document_text);
    json.member("checked", true);
    json.list("messages", [] {});
  });
  return {.body = json.written()};
}

/// Without a name those that a text finds; with one its curves.
Answer Answers::materials(const Query& query) {
  io::JsonWriter json(io::JsonWriter::Layout::compact);
  std::vector<Material> found;
  try {
    found = search_materials(query.text("text", 100));
  } catch (const InputError&) {
    // None is no error here.
  }
  const bool with_curves = query.integer("curves", 0, 1) == 1;
  json.object([&] {
    json.list("materials", [&] {
      for (std::size_t m = 0; m < std::min(found.size(), with_curves ? std::size_t{1} : kMostMaterials); ++m)
        json.object([&] {
          json.member("name", found[m].name);
          json.member("group", found[m].group);
          if (!with_curves) return;
          json.list("curves", [&] {
            for (const Material::Curve& curve : found[m].curves)
              json.object([&] {
                json.member("name", curve.name);
                json.member("um", curve.wavelength_um);
                json.member("reflectance", curve.reflectance);
                json.member("emissivity", curve.emissivity);
              });
          });
        });
    });
  });
  return {.body = json.written()};
}

}  // namespace ifov::viewer
