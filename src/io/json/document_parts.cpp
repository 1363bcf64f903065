#include "io/json/document_parts.h"

#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "core/names.h"
#include "core/printable.h"
#include "io/files/input_file.h"
#include "io/json/json_writer.h"

namespace ifov::io {

namespace {
constexpr const char *kInstruments = "instruments", *kInstrument = "instrument";
constexpr std::size_t kShown = 200;  // of a name
}  // namespace

/// Copies nodes of several trees into one.
class NodeMerger {
 public:
  struct Override {
    const DocumentOverride* what = nullptr;
    const DocumentNode* value = nullptr;
  };

  /// `layers`: the strongest first.
  static std::unique_ptr<const DocumentNode> merge(const std::vector<const DocumentNode*>& layers,
                                                   const std::vector<Override>& overrides) {
    auto root = std::unique_ptr<DocumentNode>(new DocumentNode());
    fill(*root, layers, overrides, 0);
    root->read_ = true;
    return root;
  }

  /// The same document with one of its instruments as its sensor; `overrides` are of that.
  static std::unique_ptr<const DocumentNode> with_sensor(const DocumentNode& document,
                                                         const DocumentNode& instrument,
                                                         const std::vector<Override>& overrides) {
    auto root = std::unique_ptr<DocumentNode>(new DocumentNode());
    root->source_ = document.source_, root->offset_ = document.offset_, root->type_ = Type::object;
    root->children_.reserve(document.children_.size() + 1);
    const auto add = [&](const std::string& key, const DocumentNode& value,
                         const std::vector<Override>& within_it) {
      DocumentNode& child = root->children_.emplace_back(DocumentNode());
      child.parent_ = root.get();
      child.key_ = key;
      fill(child, {&value}, within_it, 1);
    };
    for (const DocumentNode& child : document.children_)
      if (child.key_ != kInstruments && child.key_ != kInstrument) add(child.key_, child, {});
    add("sensor", instrument, overrides);
    root->read_ = true;
    return root;
  }

 private:
  using Layers = std::vector<const DocumentNode*>;
  using Type = DocumentNode::Type;

  /// Overrides are of this node or of what is within; their first `depth` steps lead here.
  static void fill(DocumentNode& node, Layers layers, std::vector<Override> overrides, std::size_t depth) {
    for (std::size_t k = overrides.size(); k-- > 0;) {
      if (overrides[k].what->steps.size() > depth) continue;
      layers = {overrides[k].value};
      overrides.erase(overrides.begin(), overrides.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      break;
    }
    if (layers.empty()) {  // a key that only overrides lead through
      node.type_ = Type::object;
      node.source_ = overrides.front().value->source_;
    } else {
      const DocumentNode& strongest = *layers.front();
      node.source_ = strongest.source_;
      node.offset_ = strongest.offset_, node.key_offset_ = strongest.key_offset_;
      node.type_ = strongest.type_;
      node.is_integer_ = strongest.is_integer_, node.boolean_ = strongest.boolean_;
      node.number_ = strongest.number_, node.integer_ = strongest.integer_, node.text_ = strongest.text_;
    }
    for (const Override& one : overrides)
      require_way(layers.empty() ? node : *layers.front(), node.title(), one, depth);
    if (node.type_ == Type::list) fill_items(node, *layers.front(), overrides, depth);
    if (node.type_ == Type::object) fill_members(node, layers, overrides, depth);
  }

  /// `node`: what is there, under the `title` that it will have.
  static void require_way(const DocumentNode& node, const std::string& title, const Override& one,
                          std::size_t depth) {
    const DocumentOverride::Step& step = one.what->steps[depth];
    if (node.type_ == (step.key.empty() ? Type::list : Type::object)) return;
    std::string hint;
    if (node.type_ == Type::list && title.size() > 2 && title.front() == '\'')
      hint = format("; its first item is {}[0]", title.substr(1, title.size() - 2));
    throw InputError(format("--set {}: {} is {}, not {}{}", one.what->path, title, node.found(),
                            step.key.empty() ? "a list" : "an object", hint));
  }

  static std::vector<Override> within(const std::vector<Override>& overrides, std::size_t depth,
                                      std::string_view key, std::size_t index) {
    std::vector<Override> chosen;
    for (const Override& one : overrides) {
      const DocumentOverride::Step& step = one.what->steps[depth];
      if (step.key == key && (!key.empty() || step.index == index)) chosen.push_back(one);
    }
    return chosen;
  }

  /// Whether the last of the overrides of a member or item says so.
  static bool is_taken_away(const std::vector<Override>& inner, std::size_t depth) {
    return !inner.empty() && inner.back().what->steps.size() == depth + 1 &&
           inner.back().value->type_ == Type::null;
  }

  static void fill_items(DocumentNode& node, const DocumentNode& from, const std::vector<Override>& overrides,
                         std::size_t depth) {
    const std::size_t count = from.children_.size();
    for (const Override& one : overrides)
      if (one.what->steps[depth].index >= count)
        throw InputError(format("--set {}: {} has {} item{}, counted from 0", one.what->path, node.title(),
                                count, count == 1 ? "" : "s"));
    node.children_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<Override> inner = within(overrides, depth, {}, i);
      if (is_taken_away(inner, depth)) continue;
      DocumentNode& child = node.children_.emplace_back(DocumentNode());
      child.parent_ = &node;
      child.index_ = i;
      fill(child, {&from.children_[i]}, inner, depth + 1);
    }
  }

  static void fill_members(DocumentNode& node, const Layers& layers, const std::vector<Override>& overrides,
                           std::size_t depth) {
    std::vector<std::pair<std::string, Layers>> members;
    const auto member = [&](const std::string& key) -> Layers& {
      for (auto& [name, list] : members)
        if (name == key) return list;
      return members.emplace_back(key, Layers()).second;
    };
    if (layers.size() == 1)
      for (const DocumentNode& child : layers.front()->children_) members.push_back({child.key_, {&child}});
    else
      for (const DocumentNode* layer : layers) {
        if (layer->type_ != Type::object) break;  // replaced by what is stronger, with all beneath it
        for (const DocumentNode& child : layer->children_) member(child.key_).push_back(&child);
      }
    for (const Override& one : overrides) member(one.what->steps[depth].key);
    node.children_.reserve(members.size());
    for (const auto& [key, list] : members) {
      if (node.parent_ == nullptr && key == "include") continue;
      const std::vector<Override> inner = within(overrides, depth, key, 0);
      const bool null = inner.empty() && layers.size() > 1 && list.front()->type_ == Type::null;
      if (is_taken_away(inner, depth) || null) continue;
      DocumentNode& child = node.children_.emplace_back(DocumentNode());
      child.parent_ = &node;
      child.key_ = key;
      fill(child, list, inner, depth + 1);
    }
  }
};

namespace {

constexpr std::size_t kMostIncluded = 256;

/// The trees of a document and of all that it includes, the strongest first.
class Gatherer {
 public:
  void gather(std::string text, const std::string& file_name, std::vector<std::string> open) {
    bytes_ += text.size();
    open.push_back(real_name(file_name));
    trees_.push_back(parse_json(std::move(text), file_name));
    const DocumentNode& root = *trees_.back().root;
    if (root.type() != DocumentNode::Type::object) return;
    const DocumentNode* included = root.find("include");
    if (included == nullptr) return;
    std::vector<const DocumentNode*> names{included};
    if (included->type() == DocumentNode::Type::list) {
      names.clear();
      for (const DocumentNode& item : included->items()) names.push_back(&item);
    }
    // Of several the last counts most, as if each were written over those before it.
    for (std::size_t k = names.size(); k-- > 0;) include(*names[k], open);
  }

  std::vector<DocumentTree> trees_;
  std::vector<std::string> files_;

 private:
  static std::string real_name(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(file, ignored).string();
  }

  void include(const DocumentNode& name, const std::vector<std::string>& open) {
    if (name.type() != DocumentNode::Type::text || name.text().empty())
      name.fail_expected("the name of a document, or a list of them");
    const std::string file = name.source().resolve(name.text());
    if (std::find(open.begin(), open.end(), real_name(file)) != open.end())
      name.fail(format("'{}' includes itself", file));
    if (files_.size() == kMostIncluded)
      name.fail(format("more than {} documents are included", kMostIncluded));
    const std::size_t most = JsonRules().max_bytes;
    std::string text;
    try {
      text = read_document_text(file);
    } catch (const SystemError& error) {
      name.fail(error.what());
    }
    if (bytes_ + text.size() > most)
      name.fail(format("the document and what it includes have more than the {} bytes allowed", most));
    files_.push_back(file);
    gather(std::move(text), file, open);
  }

  std::size_t bytes_ = 0;
};

bool is_json_text(std::string_view value) {
  if (value.front() == '{' || value.front() == '[' || value.front() == '"') return true;
  if (value == "true" || value == "false" || value == "null") return true;
  return value.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
}

/// What stands in a document's files and the command line, before an instrument is chosen.
class Gathered {
 public:
  Gathered(std::string text, const std::string& file_name, std::span<const DocumentOverride> overrides) {
    Gatherer gatherer;
    gatherer.gather(std::move(text), file_name, {});
    trees_ = std::move(gatherer.trees_);
    parts_.is_one_text = trees_.size() == 1 && overrides.empty();
    std::vector<const DocumentNode*> layers;
    bool has_several = false;
    for (const DocumentTree& tree : trees_) {
      if (tree.root->type() != DocumentNode::Type::object) tree.root->fail_expected("an object");
      has_several = has_several || tree.root->find(kInstruments) != nullptr;
      layers.push_back(tree.root.get());
      parts_.sources.push_back(tree.source);
    }
    parts_.included = std::move(gatherer.files_);
    std::vector<NodeMerger::Override> replacing;
    values_.reserve(overrides.size());
    for (const DocumentOverride& one : overrides) {
      const std::string json = is_json_text(one.value) ? one.value : json_string(one.value);
      values_.push_back(parse_json(json, format("--set {}", one.path)));
      auto& list = has_several && one.steps.front().key == "sensor" ? of_sensor_ : replacing;
      list.push_back({&one, values_.back().root.get()});
      parts_.sources.push_back(values_.back().source);
    }
    if (parts_.is_one_text)
      parts_.root = std::move(trees_.front().root);
    else
      parts_.root = NodeMerger::merge(layers, replacing);
    find_instruments();
  }

  /// Of several; empty where there are none or one is chosen.
  std::vector<std::string> choices() const {
    return chosen_ == nullptr && names_.size() > 1 ? names_ : std::vector<std::string>{};
  }

  DocumentParts whole() {
    if (instruments_ == nullptr) return std::move(parts_);
    const DocumentNode* const one = instruments_->find(chosen_ != nullptr ? chosen_->text() : names_.front());
    if (!choices().empty())
      instruments_->fail(format(
          "the document has {} instruments, {}: choose one, as --set {}={} does; ifov render, check and sensor take all of them",
          names_.size(), list_names(names_, "and"), kInstrument, names_.front()));
    if (one == nullptr)
      chosen_->fail(format("{} is '{}'; expected {}{}", chosen_->title(), printable(chosen_->text(), kShown),
                           list_names(names_), did_you_mean(chosen_->text(), names_)));
    parts_.instrument = one->key();
    parts_.is_one_text = false;
    parts_.root = NodeMerger::with_sensor(*parts_.root, *one, of_sensor_);
    return std::move(parts_);
  }

 private:
  void find_instruments() {
    instruments_ = parts_.root->find(kInstruments);
    chosen_ = parts_.root->find(kInstrument);
    if (chosen_ != nullptr && chosen_->type() != DocumentNode::Type::text)
      chosen_->fail_expected("the name of one of the 'instruments'");
    if (instruments_ == nullptr) {
      if (chosen_ != nullptr)
        chosen_->fail(format("an instrument '{}' is chosen, and there are no 'instruments'",
                             printable(chosen_->text(), kShown)));
      return;
    }
    if (instruments_->type() != DocumentNode::Type::object || instruments_->members().empty())
      instruments_->fail_expected("an object with a sensor under the name of each instrument");
    for (const DocumentNode& one : instruments_->members()) {
      if (!is_plain_name(one.key()))
        one.fail_at_key(format(
            "an instrument is called '{}'; expected letters, digits, '-' and '_', at most 100, as it names a folder",
            printable(one.key(), kShown)));
      names_.push_back(one.key());
    }
    if (const DocumentNode* const sensor = parts_.root->find("sensor"))
      sensor->fail_at_key("'sensor' and 'instruments' are given; give one of them");
  }

  static bool is_plain_name(const std::string& name) {
    const auto plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
             c == '_';
    };
    return !name.empty() && name.size() <= 100 && name.front() != '-' &&
           std::all_of(name.begin(), name.end(), plain);
  }

  std::vector<DocumentTree> trees_, values_;
  std::vector<NodeMerger::Override> of_sensor_;
  DocumentParts parts_;
  const DocumentNode* instruments_ = nullptr;
  const DocumentNode* chosen_ = nullptr;
  std::vector<std::string> names_;
};

}  // namespace

DocumentParts put_together(std::string text, const std::string& file_name,
                           std::span<const DocumentOverride> overrides) {
  return Gathered(std::move(text), file_name, overrides).whole();
}

std::vector<std::string> names_of_instruments(std::string text, const std::string& file_name,
                                              std::span<const DocumentOverride> overrides) {
  return Gathered(std::move(text), file_name, overrides).choices();
}

std::string read_document_text(const std::string& path, std::size_t max_bytes) {
  const InputFile file(path);
  if (file.size() > max_bytes)
    throw InputError(
        format("{}: the document has {} bytes, more than the {} allowed", path, file.size(), max_bytes),
        {path, 0, 0});
  return file.text();
}

}  // namespace ifov::io
