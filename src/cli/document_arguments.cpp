#include "cli/document_arguments.h"

namespace ifov::cli {

void DocumentArguments::add_to(CLI::App& parser) {
  parser
      .add_option(
          "--set", set,
          "Put a value in place of the document's: --set sensor.camera.orthographic.gsd=\"2 m\", --set light.sky=null "
          "to take a key away; may be given more than once")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Document DocumentArguments::read(const std::string& file, const std::string& instrument) const {
  std::vector<std::string> with = set;
  with.push_back("instrument=" + instrument);
  return Document::read(file, with);
}

}  // namespace ifov::cli
