#include "io/products/report_format.h"

#include "io/products/part_file.h"
#include "io/quantities/quality_quantities.h"
#include "io/quantities/radiance_quantities.h"
#include "io/report/report.h"

namespace ifov::io::formats {
namespace {

void write_report(PartFile& file, const FormatInput& from) {
  ReportInput input;
  input.picture = from.picture_channels;
  input.radiance = from.values_of(quantities::kRadiance);
  input.half_width = from.values_of(quantities::kHalfWidth);
  input.samples = from.values_of(quantities::kSamples);
  input.quality = from.values_of(quantities::kQuality);
  input.reasons = from.values_of(quantities::kReasons);
  write_part(file, make_report(from.record, input));
}

}  // namespace

constinit const ProductFormat kHtml{
    .name = "html", .ending = "_report.html", .what = "report", .write = write_report};

}  // namespace ifov::io::formats
