#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/info/product_info.h"
#include "cli/info/region_info.h"
#include "cli/inputs_below.h"
#include "cli/terminal/say.h"

namespace ifov::cli {

Command add_info_command(CLI::App& app) {
  struct Wanted {
    std::string product;
    std::vector<std::string> regions;
  };
  auto wanted = std::make_shared<Wanted>();
  CLI::App* parser = app.add_subcommand(
      "info", "Say what a product is: size, channels, accuracy reached, cost; or what a region's mean is");
  parser
      ->add_option("PRODUCT", wanted->product,
                   "A folder of products, a run record (run.json) or an ENVI file (.img, .hdr)")
      ->required();
  parser
      ->add_option(
          "--region", wanted->regions,
          "Mean radiance over a region, with its interval; may be given several times. x0,y0,x1,y1 is a rectangle "
          "in pixels, x,y,x,y,x,y,... a polygon, 'map:' before them makes them map coordinates, mask:FILE is an "
          "ENVI raster of the image's size that is not 0 inside")
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("REGION");
  add_inputs_below(*parser);
  parser->footer(
      "Examples:\n"
      "  ifov info out\n"
      "  ifov info out/scene_radiance.img\n"
      "  ifov info out --region 10,20,42,36\n"
      "  ifov info out --region map:500010,4200100,500060,4200150 --region mask:roofs.img");
  return {parser, [wanted] {
            const std::string text = wanted->regions.empty()
                                         ? describe_product(wanted->product)
                                         : describe_regions(wanted->product, wanted->regions);
            say(text);
            return ExitCode::ok;
          }};
}

}  // namespace ifov::cli
