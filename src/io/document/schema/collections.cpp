#include <algorithm>

#include "core/format.h"
#include "core/names.h"
#include "io/document/schema/schema_type.h"

namespace ifov::io {
namespace {

using Form = ValueDescription::Form;
using Type = DocumentNode::Type;

constexpr std::size_t kLongestKey = 200;

}  // namespace

bool takes_count(const ValueDescription& description, std::size_t count) {
  return count >= description.min_count && count <= description.max_count;
}

void check_list(const DocumentNode& node, const ValueDescription& description) {
  if (node.type() != Type::list) node.fail_expected(description.expected);
  if (!takes_count(description, node.items().size())) node.fail_expected(description.expected);
}

void check_map(const DocumentNode& node, const ValueDescription& description) {
  if (node.type() != Type::object) node.fail_expected(description.expected);
  if (!takes_count(description, node.members().size())) node.fail_expected(description.expected);
  for (const DocumentNode& member : node.members()) {
    if (member.key().empty() || member.key().size() > kLongestKey) {
      member.fail_at_key(format("a name has between 1 and {} bytes", kLongestKey));
    }
  }
}

ValueDescriptionPtr list_description(ValueDescriptionPtr items, std::size_t least, std::size_t most) {
  ValueDescription d;
  d.form = Form::list;
  d.min_count = least;
  d.max_count = most;
  const std::string count = least == most ? format("{}", least) : format("{} to {}", least, most);
  d.expected = format("a list of {}, each {}", count, items->expected);
  d.short_name = format("list of {}: {}", count, items->short_name);
  d.items = std::move(items);
  return std::make_shared<const ValueDescription>(std::move(d));
}

ValueDescriptionPtr map_description(ValueDescriptionPtr items, const std::string& of_what, std::size_t most) {
  ValueDescription d;
  d.form = Form::map;
  d.min_count = 0;
  d.max_count = most;
  d.expected = format("an object of at most {} {} by name", most, of_what);
  d.short_name = format("{} by name", of_what);
  d.items = std::move(items);
  return std::make_shared<const ValueDescription>(std::move(d));
}

ValueDescriptionPtr choice_description(std::vector<std::string> names) {
  ValueDescription d;
  d.expected = list_names(names);
  d.short_name = d.expected;
  d.choices = std::move(names);
  return std::make_shared<const ValueDescription>(std::move(d));
}

std::size_t choice_index(const DocumentNode& node, const ValueDescription& description) {
  const std::string& word = text_of(node, description);
  const auto found = std::find(description.choices.begin(), description.choices.end(), word);
  if (found == description.choices.end()) {
    node.fail(format("{} is {}, expected {}{}", node.title(), node.found(), description.expected,
                     did_you_mean(word, description.choices)));
  }
  return static_cast<std::size_t>(found - description.choices.begin());
}

}  // namespace ifov::io
