#include <mutex>

#include "core/format.h"
#include "io/product_parts/netcdf_file.h"
#include "io/product_parts/run_record.h"
#include "io/product_parts/view_values.h"
#include "io/raster/netcdf_lock.h"
#include "sensor/view_list.h"

namespace ifov::io {
namespace {

class Writer {
 public:
  Writer(const std::string& path, const RunRecord& record, const ViewValues& values)
      : file_(path), record_(record), values_(values) {}

  void write() {
    define();
    file_.end_definition();
    file_.put(names_, channel_names_);
    for (const auto& [id, values] : doubles_) file_.put(id, values);
    file_.close();
  }

 private:
  int variable(const std::string& name, const std::vector<int>& dimensions, const std::string& long_name,
               const std::string& units) const {
    return file_.variable(name, NC_DOUBLE, dimensions, long_name, units);
  }
  /// Doubles that are written once all is defined.
  void keep(int id, std::vector<double> values) { doubles_.emplace_back(id, std::move(values)); }
  void keep(int id, const std::vector<float>& values, double scale = 1.0) {
    std::vector<double> wide;
    for (const float value : values) wide.push_back(scale * static_cast<double>(value));
    keep(id, std::move(wide));
  }

  void define() {
    const sensor::ViewList& list = *record_.image.views;
    const auto& channels = record_.image.channels;
    for (const auto& c : channels) channel_names_.push_back(c.name);
    const int view = file_.dimension("view", values_.views),
              channel = file_.dimension("channel", values_.channels),
              length = file_.dimension("name_length", name_length(channel_names_));
    file_.text(NC_GLOBAL, "Conventions", "CF-1.8");
    file_.text(NC_GLOBAL, "title", format("synthetic {} of single views", values_.name));
    file_.text(NC_GLOBAL, "source",
               format("ifov {}, document {}, seed {}, sampler {}", record_.identity.version,
                      record_.identity.document_path, record_.identity.seed, record_.identity.sampler));
    if (!record_.outcome.accuracy_statement.empty())
      file_.text(NC_GLOBAL, "comment", record_.outcome.accuracy_statement);

    std::vector<double> centres, widths;
    for (const auto& c : channels) centres.push_back(c.centre_um), widths.push_back(c.fwhm_um);
    names_ = file_.variable("channel_name", NC_CHAR, {channel, length}, "name of the channel", "");
    const int wavelength = variable("wavelength", {channel}, "centre of the channel", "um");
    file_.text(wavelength, "standard_name", "radiation_wavelength");
    keep(wavelength, std::move(centres));
    keep(variable("fwhm", {channel}, "full width of the channel at half maximum", "um"), std::move(widths));
    for (std::size_t k = 0; k < list.columns.size(); ++k) {
      std::vector<double> column;
      for (std::size_t v = 0; v < values_.views; ++v) column.push_back(list.value(v, k));
      keep(variable(list.columns[k].name, {view}, list.columns[k].name, list.columns[k].unit),
           std::move(column));
    }

    const std::string unit = record_.image.radiance_unit, name = values_.name;
    const std::string interval =
        format("half-width of its {:g} % interval", 100.0 * record_.identity.confidence);
    const int value = variable(name, {view, channel}, name, unit);
    keep(value, values_.value);
    std::string others;
    if (!values_.half_width.empty()) {
      keep(variable("half_width", {view, channel}, interval, unit), values_.half_width);
      others = "half_width";
    }
    if (!values_.standard_error.empty()) {
      keep(variable("standard_error", {view, channel}, "standard error", unit), values_.standard_error);
      others += " standard_error";
    }
    if (!others.empty()) file_.text(value, "ancillary_variables", others);
    if (values_.has_reflectance) define_reflectance(view, channel, interval);
    if (!values_.albedo.empty()) define_albedo(channel, interval);
    if (!values_.sky_view.empty()) {
      keep(variable("sky_view", {view}, "share of the sky that is seen, weighed by cosines", "1"),
           values_.sky_view);
      keep(variable("sky_view_half_width", {view}, interval, "1"), values_.sky_view_half_width);
    }
    if (!values_.samples.empty())
      keep(variable("samples", {view}, "samples that were taken", "1"), values_.samples);
    std::vector<double> converged;
    for (const float reason : values_.reasons) converged.push_back(reason == 0.0f ? 1.0 : 0.0);
    if (!converged.empty())
      keep(variable("converged", {view}, "1 where the accuracy asked for was reached", "1"),
           std::move(converged));
  }

  void define_reflectance(int view, int channel, const std::string& interval) {
    std::vector<double> factors, half_widths;
    for (std::size_t i = 0; i < values_.value.size(); ++i) {
      const double scale = reflectance_scale(record_, i % values_.channels);
      factors.push_back(scale * static_cast<double>(values_.value[i]));
      if (!values_.half_width.empty())
        half_widths.push_back(scale * static_cast<double>(values_.half_width[i]));
    }
    keep(variable("reflectance_factor", {view, channel},
                  "radiance over that of a level white Lambertian surface in the same light", "1"),
         std::move(factors));
    if (!half_widths.empty())
      keep(variable("reflectance_half_width", {view, channel}, interval, "1"), std::move(half_widths));
  }

  void define_albedo(int channel, const std::string& interval) {
    std::vector<double> value, error, half_width;
    for (const Albedo& albedo : values_.albedo) {
      value.push_back(albedo.value);
      error.push_back(albedo.standard_error);
      half_width.push_back(albedo.half_width);
    }
    const int id =
        variable("albedo", {channel}, "mean reflectance factor over the hemisphere, weighed by cosines", "1");
    file_.text(id, "ancillary_variables", "albedo_half_width albedo_standard_error");
    keep(id, std::move(value));
    keep(variable("albedo_half_width", {channel}, interval, "1"), std::move(half_width));
    keep(variable("albedo_standard_error", {channel}, "standard error", "1"), std::move(error));
  }

  NetcdfFile file_;
  const RunRecord& record_;
  const ViewValues& values_;
  int names_ = 0;
  std::vector<std::string> channel_names_;
  std::vector<std::pair<int, std::vector<double>>> doubles_;
};

}  // namespace

void write_view_netcdf(const std::string& path, const RunRecord& record, const ViewValues& values) {
  const std::scoped_lock lock(netcdf_mutex());
  Writer(path, record, values).write();
}

}  // namespace ifov::io
