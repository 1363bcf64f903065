#include <algorithm>
#include <filesystem>

#include "core/format.h"
#include "io/document/output_document.h"
#include "io/document/product_words.h"
#include "io/document/schema/record.h"
#include "io/document/tables/tables.h"
#include "io/quantities/quantity.h"

namespace ifov::io {
namespace {

struct Quicklook {
  std::vector<DocumentName> channels;
};

/// A document from somewhere else must not choose where on this machine files appear: only who starts the program may.
/// The name as written: it lies beside the document that is rendered, whichever of those that it includes gives it.
SchemaType<std::string> folder_type() {
  const SchemaType<DocumentFile> any = file();
  ValueDescription d = *any.description;
  d.expected =
      "the name of a folder beside the document or below it; 'ifov render --output FOLDER' writes anywhere";
  d.short_name = "folder name";
  d.pattern = "^(?!/)(?!(.*/)?\\.\\.(/|$))[^\\u0000]+$";
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  const auto any_folder = [](const std::string& folder, Writing& writing) -> Written {
    return file_from(writing.folder, folder);
  };
  return {description,
          [description, read = any.read](const DocumentNode& node) {
            const std::filesystem::path path = text_of(node, *description);
            if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
              node.fail_expected(description->expected);
            read(node);
            return path.string();
          },
          any_folder};
}

SchemaType<std::vector<std::string>> formats_type() {
  std::vector<std::pair<std::string, std::string>> words;
  for (const std::string_view word : product_words()) words.emplace_back(word, word);
  const SchemaType<std::vector<std::string>> type = list(choice<std::string>(words), 1, words.size());
  return {type.description,
          [read = type.read](const DocumentNode& node) {
            std::vector<std::string> chosen = read(node);
            for (const std::string& word : chosen)
              if (const std::string why = why_not_built(word); !why.empty())
                node.fail(format("'{}': {}", word, why));
            return chosen;
          },
          type.write};
}

/// "["envi", "png", "html"]"
std::string usual_formats() {
  std::string list;
  for (const std::string& word : usual_product_words())
    list += format("{}\"{}\"", list.empty() ? "[" : ", ", word);
  return list + "]";
}

/// Only what is a good file name everywhere.
SchemaType<std::string> name_type() {
  ValueDescription d;
  d.expected = "letters, digits, '-' and '_', of which the first is no '-', at most 100";
  d.short_name = "name of files";
  d.pattern = "^[A-Za-z0-9_][A-Za-z0-9_-]{0,99}$";
  auto description = std::make_shared<const ValueDescription>(std::move(d));
  return {description,
          [description](const DocumentNode& node) {
            const std::string name = text_of(node, *description);
            const auto plain = [](char c) {
              return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                     c == '_';
            };
            if (name.empty() || name.size() > 100 || name.front() == '-' ||
                !std::all_of(name.begin(), name.end(), plain))
              node.fail_expected(description->expected);
            return name;
          },
          [](const std::string& name, Writing&) { return Written(name); }};
}

/// Cubes by their names; "all" for every one.
SchemaType<QuantitySet> products_type() {
  const auto all = all_quantities();
  std::vector<std::pair<std::string, int>> words;
  for (std::size_t k = 0; k < all.size(); ++k) words.emplace_back(all[k]->name, static_cast<int>(k));
  words.emplace_back("all", -1);
  const std::size_t most = words.size();
  return converted<QuantitySet>(
      list(choice<int>(words), 1, most),
      [](const std::vector<int>& names) {
        QuantitySet quantities;
        for (const int name : names) {
          if (name < 0) return QuantitySet::all();
          quantities.add(*all_quantities()[static_cast<std::size_t>(name)]);
        }
        return quantities;
      },
      [all](const QuantitySet& quantities) {
        if (quantities == QuantitySet::all()) return std::vector{-1};
        std::vector<int> names;
        for (std::size_t k = 0; k < all.size(); ++k)
          if (quantities.has(*all[k])) names.push_back(static_cast<int>(k));
        return names;
      });
}

SchemaType<Quicklook> quicklook_type() {
  Record<Quicklook> record("quick-look", "The picture for the eye.");
  record
      .required("channels", &Quicklook::channels, list(name_of("a channel"), 1, 3),
                "one channel for grey, or three for red, green and blue")
      .check([](const Quicklook& quicklook, const DocumentNode& node) {
        if (quicklook.channels.size() == 2) {
          node.find("channels")
              ->fail(format("{} has two channels: a picture has one, or three for red, green and blue",
                            node.given("channels").title()));
        }
      });
  return record.type();
}

}  // namespace

SchemaType<OutputDocument> output_type() {
  Record<OutputDocument> record("output", "What is written, and where.");
  record
      .optional(
          "folder", &OutputDocument::folder, folder_type(),
          "folder of the products, relative to the document; the document's name with '.out' if not given")
      .with_default("name", &OutputDocument::name, name_type(), "\"image\"",
                    "begins the name of every product")
      .with_default("formats", &OutputDocument::formats, formats_type(), usual_formats(),
                    "kinds of products; the ENVI cubes and the run record are always written")
      .with_default(
          "interleave", &OutputDocument::interleave,
          choice<std::string>({{"bil", "bil"}, {"bsq", "bsq"}, {"bip", "bip"}}), "\"bil\"",
          "how values lie in the ENVI cubes: line by line, in each band by band (bil); band by band (bsq); or pixel by pixel, in each "
          "band by band (bip)")
      .optional(
          "products", &OutputDocument::products, products_type(),
          "ENVI cubes beside the radiance, which is always written; if not given, those of the samples, the quality, the "
          "abundances and half_width, and of frame cameras location")
      .optional("quicklook",
                via([](OutputDocument& output,
                       Quicklook quicklook) { output.quicklook_channels = std::move(quicklook.channels); },
                    [](const OutputDocument& output) {
                      const bool chosen = !output.quicklook_channels.empty();
                      return chosen ? std::optional(Quicklook{output.quicklook_channels}) : std::nullopt;
                    }),
                quicklook_type(), "channels of the picture; chosen if not given");
  return record.type();
}

}  // namespace ifov::io
