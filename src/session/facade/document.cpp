#include "ifov/document.h"

#include <optional>

#include "core/call_scope.h"
#include "io/files/inputs.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/preview_document.h"

namespace ifov {
namespace {

std::vector<io::DocumentOverride> overrides_of(const std::vector<std::string>& set) {
  std::vector<io::DocumentOverride> overrides;
  for (const std::string& written : set) overrides.push_back(io::read_override(written));
  return overrides;
}

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

/// Of the calls of this thread, for all that will be read for a document.
std::shared_ptr<const io::Inputs> own_inputs() {
  return std::make_shared<const io::Inputs>(io::current_inputs());
}

}  // namespace

Document FacadeAccess::document(Document::Inside inside) {
  return Document(std::make_shared<const Document::Inside>(std::move(inside)));
}

std::shared_ptr<const Call::Data> FacadeAccess::inputs(const Document& document) {
  return document.inside_->inputs;
}

std::function<io::Document(const std::string&)> FacadeAccess::at_times(const Document& document) {
  return [inside = document.inside_](const std::string& time) { return inside->again({"time=" + time}); };
}

Document Document::read(const std::filesystem::path& file, const std::vector<std::string>& set) {
  const auto again = [file, set](const std::vector<std::string>& more) {
    return io::read_document(file.string(), overrides_of(joined(set, more)));
  };
  return FacadeAccess::document({again({}), own_inputs(), again});
}

Document Document::parse(const std::string& text, const std::string& name,
                         const std::filesystem::path& folder, const std::vector<std::string>& set) {
  const auto again = [=](const std::vector<std::string>& more) {
    return io::parse_document(text, (folder / name).string(), overrides_of(joined(set, more)));
  };
  return FacadeAccess::document({again({}), own_inputs(), again});
}

Document Document::with_assets(const Assets& assets) const {
  io::Inputs inputs = *inside_->inputs;
  inputs.assets = std::make_shared<const io::Assets>(FacadeAccess::inside(assets));
  return FacadeAccess::document(
      {inside_->document, std::make_shared<const io::Inputs>(std::move(inputs)), inside_->again});
}

Document Document::for_preview(int longest_px) const {
  const auto smaller = [longest_px, inputs = inside_->inputs](const io::Document& whole) {
    const Call call{inputs};  // a table of channels may be a file
    const CallScope scope(call);
    return session::for_preview(whole, longest_px);
  };
  return FacadeAccess::document({smaller(inside_->document), inside_->inputs,
                                 [smaller, whole = inside_->again](const std::vector<std::string>& more) {
                                   return smaller(whole(more));
                                 }});
}

std::string Document::name() const { return inside_->document.sources.file_name; }

std::filesystem::path Document::output_folder() const { return inside_->document.output.folder; }

std::string document_schema() { return io::schema_json(); }

std::string document_reference() { return io::schema_markdown(); }

struct InputsBelow::Inside {
  Call call;
  std::optional<CallScope> scope;
};

InputsBelow::InputsBelow(const std::filesystem::path& folder) : inside_(std::make_unique<Inside>()) {
  auto inputs = std::make_shared<io::Inputs>(io::current_inputs());
  inputs->below = io::folder_of_inputs(folder);
  inside_->call = {std::move(inputs), current_call().cancel};
  inside_->scope.emplace(inside_->call);
}

InputsBelow::~InputsBelow() = default;

}  // namespace ifov
