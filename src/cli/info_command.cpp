#include <CLI/CLI.hpp>
#include <cstdio>

#include "cli/command.h"
#include "cli/product_info.h"

namespace ifov::cli {

Command add_info_command(CLI::App& app) {
  auto product = std::make_shared<std::string>();
  CLI::App* parser =
      app.add_subcommand("info", "Say what a product is: size, channels, accuracy reached, cost");
  parser
      ->add_option("PRODUCT", *product,
                   "A folder of products, a run record (run.json) or an ENVI file (.img, .hdr)")
      ->required();
  parser->footer(
      "Examples:\n"
      "  ifov info out\n"
      "  ifov info out/scene_radiance.img");
  return {parser, [product] {
            std::fputs(describe_product(*product).c_str(), stdout);
            return ExitCode::ok;
          }};
}

}  // namespace ifov::cli
