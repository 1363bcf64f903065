#include "session/scene_model/document_cuts.h"

#include <tuple>

#include "core/format.h"
#include "io/json/document_parts.h"

namespace ifov::session {
namespace {

using Step = io::DocumentOverride::Step;

constexpr std::size_t kMostCuts = 30;

// What stands where a document cannot do without.
constexpr const char* kPlainSensor =
    R"({"camera": {"orthographic": {"gsd": "1 m", "pixels": [1, 1]}}, "channels": [{"name": "B", "monochromatic": {"at": "0.55 um"}}]})";
constexpr const char* kPlainMaterial = R"({"reflectance": 0.5})";
constexpr const char* kUnknown = "(unknown)";

struct Cut {
  SourcePosition from;  ///< where what it takes away begins
  std::vector<io::DocumentOverride> overrides;
  std::string instead;
};

io::DocumentOverride override_of(std::vector<Step> steps, std::string path, std::string value) {
  return {std::move(steps), std::move(path), std::move(value)};
}

io::DocumentOverride without(std::vector<Step> steps, std::string path) {
  return override_of(std::move(steps), std::move(path), "null");
}

/// Keys that no scene can do without are no cuts.
class Cuts {
 public:
  explicit Cuts(const io::DocumentNode& root) {
    for (const io::DocumentNode& section : root.members()) {
      if (section.key() == "scene" && section.type() == io::DocumentNode::Type::object)
        of_scene(section);
      else if (section.key() == "sensor")
        add(section, {override_of({{"sensor", 0}}, "sensor", kPlainSensor)}, "no sensor is shown");
      else if (section.key() != "ifov")
        add(section, {without({{section.key(), 0}}, section.key())},
            format("'{}' is left out", section.key()));
    }
  }

  /// The last that begins at a place or before it; null: none does.
  const Cut* at(const SourcePosition& place) const {
    const auto order = [](const SourcePosition& p) { return std::tuple(p.line, p.column); };
    const Cut* found = nullptr;
    for (const Cut& cut : cuts_)
      if (cut.from.file == place.file && order(cut.from) <= order(place) &&
          (found == nullptr || order(found->from) <= order(cut.from)))
        found = &cut;
    return found;
  }

 private:
  void add(const io::DocumentNode& node, std::vector<io::DocumentOverride> overrides, std::string instead) {
    cuts_.push_back({node.key().empty() ? node.position() : node.key_position(), std::move(overrides),
                     std::move(instead)});
  }

  void of_scene(const io::DocumentNode& scene) {
    for (const io::DocumentNode& part : scene.members()) {
      const std::string path = "scene." + part.key();
      if (part.key() == "objects" && part.type() == io::DocumentNode::Type::list) {
        for (const io::DocumentNode& object : part.items()) of_object(object, object.index());
      } else if ((part.key() == "materials" || part.key() == "prototypes") &&
                 part.type() == io::DocumentNode::Type::object) {
        const bool material = part.key() == "materials";
        for (const io::DocumentNode& one : part.members()) {
          const std::vector<Step> steps{{"scene", 0}, {part.key(), 0}, {one.key(), 0}};
          const std::string name = path + "." + one.key();
          if (material)
            add(one, {override_of(steps, name, kPlainMaterial)},
                format("material '{}' is shown grey", one.key()));
          else
            add(one, {without(steps, name)}, format("prototype '{}' is left out", one.key()));
        }
      } else {
        add(part, {without({{"scene", 0}, {part.key(), 0}}, path)}, format("'{}' is left out", path));
      }
    }
  }

  void of_object(const io::DocumentNode& object, std::size_t k) {
    const std::string path = format("scene.objects[{}]", k);
    const std::vector<Step> steps{{"scene", 0}, {"objects", 0}, {{}, k}};
    const std::string gone = format("'{}' is left out", path);
    add(object, {without(steps, path)}, gone);
    if (object.type() != io::DocumentNode::Type::object) return;
    for (const io::DocumentNode& value : object.members()) {
      if (value.key() != "material") {
        add(value, {without(steps, path)}, gone);
        continue;
      }
      std::vector<Step> of_material = steps;
      of_material.push_back({"material", 0});
      add(value,
          {override_of(std::move(of_material), path + ".material", kUnknown),
           override_of({{"scene", 0}, {"materials", 0}, {kUnknown, 0}}, "scene.materials", kPlainMaterial)},
          format("'{}' is shown grey", path));
    }
  }

  std::vector<Cut> cuts_;
};

}  // namespace

DocumentCuts::DocumentCuts(std::string text, std::string file_name,
                           std::span<const io::DocumentOverride> overrides)
    : text_(std::move(text)),
      file_name_(std::move(file_name)),
      overrides_(overrides.begin(), overrides.end()) {}

std::optional<DocumentFault> DocumentCuts::cut_out(const InputError& error) {
  if (error.position().line == 0 || met_.size() == kMostCuts || !met_.insert(error.what()).second)
    return std::nullopt;
  DocumentFault fault{error.what(), error.position(), {}};
  io::DocumentParts parts;
  try {
    parts = io::put_together(text_, file_name_, overrides_);
  } catch (const InputError&) {
    return std::nullopt;  // it is no JSON
  }
  const Cuts cuts(*parts.root);
  if (const Cut* cut = cuts.at(error.position())) {
    overrides_.insert(overrides_.end(), cut->overrides.begin(), cut->overrides.end());
    fault.instead = cut->instead;
    return fault;
  }
  // Before all that is written there is what is not.
  if (parts.root->find("sensor") != nullptr) return std::nullopt;
  overrides_.push_back(override_of({{"sensor", 0}}, "sensor", kPlainSensor));
  fault.instead = "no sensor is shown";
  return fault;
}

}  // namespace ifov::session
