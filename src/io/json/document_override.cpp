#include "io/json/document_override.h"

#include <charconv>

#include "core/error.h"
#include "core/format.h"

namespace ifov::io {
namespace {

[[noreturn]] void refuse(std::string_view written, std::string_view what) {
  throw InputError(
      format("--set {}: {}; expected a key and its value, such as "
             "sensor.camera.orthographic.gsd=\"2 m\" or scene.objects[0].material=lawn",
             written, what));
}

}  // namespace

DocumentOverride read_override(std::string_view written) {
  const std::size_t equals = written.find('=');
  if (equals == std::string_view::npos) refuse(written, "there is no '='");
  DocumentOverride result;
  result.path = std::string(written.substr(0, equals));
  result.value = std::string(written.substr(equals + 1));
  const std::string_view path = result.path;
  std::size_t at = 0;
  while (at < path.size()) {
    if (path[at] == '[') {
      DocumentOverride::Step step;
      const auto read = std::from_chars(path.data() + at + 1, path.data() + path.size(), step.index);
      const auto end = static_cast<std::size_t>(read.ptr - path.data());
      if (read.ec != std::errc() || end >= path.size() || path[end] != ']')
        refuse(written, "'[' needs a number and ']'");
      if (result.steps.empty()) refuse(written, "a document has keys, and is no list");
      result.steps.push_back(std::move(step));
      at = end + 1;
    } else {
      if (!result.steps.empty() && path[at] == '.')
        ++at;
      else if (!result.steps.empty())
        refuse(written, "after ']' comes '.' or '['");
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      if (end == at) refuse(written, "a key is empty");
      result.steps.push_back({std::string(path.substr(at, end - at)), 0});
      at = end;
    }
  }
  if (result.steps.empty()) refuse(written, "there is no key");
  if (result.value.empty()) refuse(written, "there is no value");
  return result;
}

}  // namespace ifov::io
