#include "io/product_parts/view_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/format.h"
#include "io/product_parts/run_record.h"
#include "io/quantities/quality_quantities.h"
#include "io/quantities/radiance_quantities.h"
#include "io/quantities/sunlight_quantities.h"
#include "io/tables/text_table.h"
#include "sampling/intervals/quantiles.h"
#include "sensor/view_list.h"

namespace ifov::io {
namespace {

using sensor::ViewList;

/// Half-widths of more standard errors than this hold what rays cannot lower, and that is the same in all directions.
constexpr double kOfRays = 2.6;

/// The cube's line, as [view * bands + band]; empty where there is no cube.
std::vector<float> line_of(const RasterView& view, int bands) {
  if (!view) return {};
  const auto width = static_cast<std::size_t>(view.width), count = static_cast<std::size_t>(bands);
  std::vector<float> values(width * count), band(width);
  for (std::size_t b = 0; b < count; ++b) {
    view.read(0, static_cast<int>(b), band);
    for (std::size_t x = 0; x < width; ++x) values[x * count + b] = band[x];
  }
  return values;
}

std::vector<float> band_of(const RasterView& view, int band) {
  if (!view) return {};
  std::vector<float> values(static_cast<std::size_t>(view.width));
  view.read(0, band, values);
  return values;
}

/// Each two views lie by chance in one cell of equal projected solid angle: the mean of all is the integral, without a bias, and
/// what the two of a cell differ by tells its error, of rays and of directions together.
Albedo albedo_of(const ViewValues& v, std::size_t channel, double scale, double confidence) {
  const auto at = [&](std::size_t view) {
    return scale * static_cast<double>(v.value[view * v.channels + channel]);
  };
  const std::size_t cells = v.views / 2;
  double sum = 0.0, variance = 0.0, squares = 0.0, common = 0.0;
  for (std::size_t k = 0; k < cells; ++k) {
    const double difference = at(2 * k) - at(2 * k + 1);
    sum += at(2 * k) + at(2 * k + 1);
    const double own = 0.25 * difference * difference;
    variance += own, squares += own * own;
  }
  for (std::size_t k = 0; k < v.half_width.size() / std::max<std::size_t>(v.channels, 1); ++k) {
    const std::size_t i = k * v.channels + channel;
    const double error = v.standard_error.empty() ? 0.0 : static_cast<double>(v.standard_error[i]);
    common += std::max(0.0, scale * (static_cast<double>(v.half_width[i]) - kOfRays * error));
  }
  Albedo albedo;
  albedo.value = sum / static_cast<double>(v.views);
  albedo.standard_error = std::sqrt(variance) / static_cast<double>(cells);
  // Satterthwaite's degrees of freedom: a few cells may have most of the variance.
  const double degrees =
      squares > 0.0 ? std::clamp(3.0 * variance * variance / squares - 2.0, 1.0, static_cast<double>(cells))
                    : static_cast<double>(cells);
  albedo.half_width = sampling::two_sided_student(confidence, degrees) * albedo.standard_error +
                      common / static_cast<double>(v.views);
  return albedo;
}

}  // namespace

double reflectance_scale(const RunRecord& record, std::size_t channel) {
  const double irradiance = record.image.channels[channel].irradiance;
  return irradiance > 0.0 ? std::numbers::pi / irradiance : 0.0;
}

ViewValues view_values(const RunRecord& record, const std::function<RasterView(const Quantity&)>& values_of) {
  const ViewList& list = *record.image.views;
  ViewValues v;
  v.views = list.count(), v.channels = record.image.channels.size();
  const int bands = static_cast<int>(v.channels);
  v.value = line_of(values_of(quantities::kRadiance), bands);
  v.half_width = line_of(values_of(quantities::kHalfWidth), bands);
  v.standard_error = line_of(values_of(quantities::kStandardError), bands);
  v.samples = band_of(values_of(quantities::kSamples), 0);
  v.reasons = band_of(values_of(quantities::kReasons), 0);
  if (list.kind == ViewList::Kind::points) {
    v.name = "irradiance";
    v.sky_view = band_of(values_of(quantities::kSkyView), 0);
    v.sky_view_half_width = band_of(values_of(quantities::kSkyView), 1);
  }
  if (list.kind == ViewList::Kind::directions || list.kind == ViewList::Kind::hemisphere)
    for (std::size_t c = 0; c < v.channels; ++c)
      v.has_reflectance = v.has_reflectance || reflectance_scale(record, c) > 0.0;
  if (list.kind == ViewList::Kind::hemisphere && v.has_reflectance)
    for (std::size_t c = 0; c < v.channels; ++c)
      v.albedo.push_back(albedo_of(v, c, reflectance_scale(record, c), record.identity.confidence));
  return v;
}

std::vector<std::string> albedo_lines(const RunRecord& record, const ViewValues& values) {
  std::vector<std::string> lines;
  for (std::size_t c = 0; c < values.albedo.size(); ++c)
    lines.push_back(
        format("albedo of channel '{}': {:.6g}, half-width {:.2g} at {:g} %, standard error {:.2g}",
               record.image.channels[c].name, values.albedo[c].value, values.albedo[c].half_width,
               100.0 * record.identity.confidence, values.albedo[c].standard_error));
  return lines;
}

std::string view_csv(const RunRecord& record, const ViewValues& v) {
  const ViewList& list = *record.image.views;
  std::string text = format("# ifov {}, document {}, seed {}, sampler {}\n", record.identity.version,
                            record.identity.document_path, record.identity.seed, record.identity.sampler);
  if (!record.outcome.accuracy_statement.empty()) text += "# " + record.outcome.accuracy_statement + "\n";
  if (!v.half_width.empty())
    text += format("# half-widths are of {:g} % intervals; values in {}\n",
                   100.0 * record.identity.confidence, record.image.radiance_unit);
  for (const std::string& line : albedo_lines(record, v)) text += "# " + line + "\n";
  text += "view";
  for (const ViewList::Column& column : list.columns) text += "," + column.name;
  text += format(",channel,wavelength_um,{}", v.name);
  if (!v.half_width.empty()) text += ",half_width";
  if (!v.standard_error.empty()) text += ",standard_error";
  if (v.has_reflectance) text += ",reflectance_factor";
  if (v.has_reflectance && !v.half_width.empty()) text += ",reflectance_half_width";
  if (!v.sky_view.empty()) text += ",sky_view,sky_view_half_width";
  text += ",samples,converged\n";
  for (std::size_t k = 0; k < v.views; ++k)
    for (std::size_t c = 0; c < v.channels; ++c) {
      const std::size_t i = k * v.channels + c;
      const double scale = v.has_reflectance ? reflectance_scale(record, c) : 0.0;
      text += format("{}", k);
      for (std::size_t column = 0; column < list.columns.size(); ++column)
        text += format(",{:.12g}", list.value(k, column));
      text += format(",{},{:.9g},{:.9g}", csv_field(record.image.channels[c].name),
                     record.image.channels[c].centre_um, v.value[i]);
      if (!v.half_width.empty()) text += format(",{:.6g}", v.half_width[i]);
      if (!v.standard_error.empty()) text += format(",{:.6g}", v.standard_error[i]);
      if (v.has_reflectance) text += format(",{:.9g}", scale * static_cast<double>(v.value[i]));
      if (v.has_reflectance && !v.half_width.empty())
        text += format(",{:.6g}", scale * static_cast<double>(v.half_width[i]));
      if (!v.sky_view.empty()) text += format(",{:.7g},{:.3g}", v.sky_view[k], v.sky_view_half_width[k]);
      text += format(",{:.0f},{}\n", v.samples.empty() ? 0.0f : v.samples[k],
                     !v.reasons.empty() && v.reasons[k] == 0.0f ? 1 : 0);
    }
  return text;
}

}  // namespace ifov::io
