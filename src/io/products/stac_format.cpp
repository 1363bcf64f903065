#include "io/product_parts/run_record.h"
#include "io/product_parts/stac_item.h"
#include "io/products/part_file.h"
#include "io/products/product_format.h"
#include "io/quantities/location_quantities.h"

namespace ifov::io {
namespace {

constexpr std::string_view kItemEnding = "_stac.json";

void write_item(PartFile& file, const FormatInput& input) {
  std::string stem = file.final_path().filename().string();
  stem.erase(stem.size() - kItemEnding.size());
  write_part(file,
             stac_item(input.record, input.wide_values_of(quantities::kLocation), file.final_path(), stem));
}

}  // namespace

constinit const ProductFormat formats::kStac{.name = "stac",
                                             .ending = kItemEnding,
                                             .what = "item of a STAC catalogue",
                                             .write = write_item,
                                             .suits = is_picture};

}  // namespace ifov::io
