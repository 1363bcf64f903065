#include "io/document/json_text.h"

#include "core/format.h"

namespace ifov::io {
namespace {

/// Just after the string that begins at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  for (++at; text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return at + 1;
}

/// Whether the list or object that begins at `at` holds no list and no object.
bool is_flat(std::string_view text, std::size_t at) {
  if (text[at] != '[') return false;
  for (++at; at < text.size(); ++at) {
    if (text[at] == '"') at = end_of_string(text, at) - 1;
    if (text[at] == '[' || text[at] == '{') return false;
    if (text[at] == ']') return true;
  }
  return true;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20) {
      quoted += format("\\u{:04x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string json_number(double value) { return format("{}", value); }

std::string json_list(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += format("{}{}", text.empty() ? "" : ",", item);
  return format("[{}]", text);
}

std::string json_object(const JsonMembers& members) {
  std::string text;
  for (const auto& [key, value] : members) {
    text += format("{}{}:{}", text.empty() ? "" : ",", json_string(key), value);
  }
  return format("{{{}}}", text);
}

std::string json_indented(std::string_view compact) {
  std::string text;
  std::size_t depth = 0;
  const auto new_line = [&] { text += '\n' + std::string(2 * depth, ' '); };
  for (std::size_t at = 0; at < compact.size(); ++at) {
    const char c = compact[at];
    if (c == '"') {
      const std::size_t end = end_of_string(compact, at);
      text += compact.substr(at, end - at);
      at = end - 1;
    } else if ((c == '[' || c == '{') && compact[at + 1] == c + 2) {
      text += {c, compact[++at]};  // an empty list or object
    } else if (is_flat(compact, at)) {
      while (compact[at] != ']') {
        const std::size_t end = compact[at] == '"' ? end_of_string(compact, at) : at + 1;
        text += compact.substr(at, end - at);
        if (compact[at] == ',') text += ' ';
        at = end;
      }
      text += ']';
    } else if (c == '[' || c == '{') {
      text += c;
      ++depth;
      new_line();
    } else if (c == ']' || c == '}') {
      --depth;
      new_line();
      text += c;
    } else if (c == ',') {
      text += c;
      new_line();
    } else {
      text += c;
      if (c == ':') text += ' ';
    }
  }
  return text + '\n';
}

}  // namespace ifov::io
