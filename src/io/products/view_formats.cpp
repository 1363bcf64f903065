#include "io/products/view_formats.h"

#include "io/product_parts/run_record.h"
#include "io/product_parts/view_values.h"
#include "io/products/part_file.h"

namespace ifov::io::formats {
namespace {

bool of_views(const render::ImageInfo& image) { return image.views != nullptr; }

}  // namespace

constinit const ProductFormat kViewCsv{
    .name = "",
    .ending = "_views.csv",
    .what = "values and errors of the views, CSV",
    .write =
        [](PartFile& file, const FormatInput& input) {
          write_part(file, view_csv(input.record, view_values(input.record, input.values_of)));
        },
    .suits = of_views};

constinit const ProductFormat kViewNetcdf{.name = "",
                                          .ending = "_views.nc",
                                          .what = "values and errors of the views, NetCDF",
                                          .write =
                                              [](PartFile& file, const FormatInput& input) {
                                                write_view_netcdf(file.part_path().string(), input.record,
                                                                  view_values(input.record, input.values_of));
                                              },
                                          .suits = of_views};

}  // namespace ifov::io::formats
