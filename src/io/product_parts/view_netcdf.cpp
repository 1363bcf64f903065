#include <array>
#include <mutex>

#include "core/error.h"
#include "io/product_parts/netcdf_functions.h"
#include "io/product_parts/run_record.h"
#include "io/product_parts/view_values.h"
#include "io/raster/netcdf_lock.h"
#include "sensor/view_list.h"

namespace ifov::io {
namespace {

/// A file that is being defined first and then filled.
class Writer {
 public:
  Writer(const std::string& path, const RunRecord& record, const ViewValues& values)
      : path_(path), record_(record), values_(values) {
    require(late::nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &file_));
  }
  ~Writer() {
    if (file_ >= 0) late::nc_abort(file_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void write() {
    define();
    require(late::nc_enddef(file_));
    fill();
    const int status = late::nc_close(file_);
    file_ = -1;
    require(status);
  }

 private:
  void require(int status) const {
    if (status != NC_NOERR)
      throw SystemError(format("{}: cannot be written: {}", path_, late::nc_strerror(status)));
  }
  void text(int variable, const char* name, const std::string& value) const {
    require(late::nc_put_att_text(file_, variable, name, value.size(), value.c_str()));
  }
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions,
               const std::string& long_name, const std::string& units) const {
    int id = 0;
    require(late::nc_def_var(file_, name.c_str(), type, static_cast<int>(dimensions.size()),
                             dimensions.data(), &id));
    text(id, "long_name", long_name);
    if (!units.empty()) text(id, "units", units);
    return id;
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
    int view = 0, channel = 0, length = 0;
    for (const auto& c : channels) name_length_ = std::max(name_length_, c.name.size());
    require(late::nc_def_dim(file_, "view", values_.views, &view));
    require(late::nc_def_dim(file_, "channel", values_.channels, &channel));
    require(late::nc_def_dim(file_, "name_length", name_length_, &length));
    text(NC_GLOBAL, "Conventions", "CF-1.8");
    text(NC_GLOBAL, "title", format("synthetic {} of single views", values_.name));
    text(NC_GLOBAL, "source",
         format("ifov {}, document {}, seed {}, sampler {}", record_.identity.version,
                record_.identity.document_path, record_.identity.seed, record_.identity.sampler));
    if (!record_.outcome.accuracy_statement.empty())
      text(NC_GLOBAL, "comment", record_.outcome.accuracy_statement);

    std::vector<double> centres, widths;
    for (const auto& c : channels) centres.push_back(c.centre_um), widths.push_back(c.fwhm_um);
    names_ = variable("channel_name", NC_CHAR, {channel, length}, "name of the channel", "");
    const int wavelength = variable("wavelength", NC_DOUBLE, {channel}, "centre of the channel", "um");
    text(wavelength, "standard_name", "radiation_wavelength");
    keep(wavelength, std::move(centres));
    keep(variable("fwhm", NC_DOUBLE, {channel}, "full width of the channel at half maximum", "um"),
         std::move(widths));
    for (std::size_t k = 0; k < list.columns.size(); ++k) {
      std::vector<double> column;
      for (std::size_t v = 0; v < values_.views; ++v) column.push_back(list.value(v, k));
      keep(variable(list.columns[k].name, NC_DOUBLE, {view}, list.columns[k].name, list.columns[k].unit),
           std::move(column));
    }

    const std::string unit = record_.image.radiance_unit, name = values_.name;
    const std::string interval =
        format("half-width of its {:g} % interval", 100.0 * record_.identity.confidence);
    const int value = variable(name, NC_DOUBLE, {view, channel}, name, unit);
    keep(value, values_.value);
    std::string others;
    if (!values_.half_width.empty()) {
      keep(variable("half_width", NC_DOUBLE, {view, channel}, interval, unit), values_.half_width);
      others = "half_width";
    }
    if (!values_.standard_error.empty()) {
      keep(variable("standard_error", NC_DOUBLE, {view, channel}, "standard error", unit),
           values_.standard_error);
      others += " standard_error";
    }
    if (!others.empty()) text(value, "ancillary_variables", others);
    if (values_.has_reflectance) define_reflectance(view, channel, interval);
    if (!values_.albedo.empty()) define_albedo(channel, interval);
    if (!values_.sky_view.empty()) {
      keep(variable("sky_view", NC_DOUBLE, {view}, "share of the sky that is seen, weighed by cosines", "1"),
           values_.sky_view);
      keep(variable("sky_view_half_width", NC_DOUBLE, {view}, interval, "1"), values_.sky_view_half_width);
    }
    if (!values_.samples.empty())
      keep(variable("samples", NC_DOUBLE, {view}, "samples that were taken", "1"), values_.samples);
    std::vector<double> converged;
    for (const float reason : values_.reasons) converged.push_back(reason == 0.0f ? 1.0 : 0.0);
    if (!converged.empty())
      keep(variable("converged", NC_DOUBLE, {view}, "1 where the accuracy asked for was reached", "1"),
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
    keep(variable("reflectance_factor", NC_DOUBLE, {view, channel},
                  "radiance over that of a level white Lambertian surface in the same light", "1"),
         std::move(factors));
    if (!half_widths.empty())
      keep(variable("reflectance_half_width", NC_DOUBLE, {view, channel}, interval, "1"),
           std::move(half_widths));
  }

  void define_albedo(int channel, const std::string& interval) {
    std::vector<double> value, error, half_width;
    for (const Albedo& albedo : values_.albedo) {
      value.push_back(albedo.value);
      error.push_back(albedo.standard_error);
      half_width.push_back(albedo.half_width);
    }
    const int id = variable("albedo", NC_DOUBLE, {channel},
                            "mean reflectance factor over the hemisphere, weighed by cosines", "1");
    text(id, "ancillary_variables", "albedo_half_width albedo_standard_error");
    keep(id, std::move(value));
    keep(variable("albedo_half_width", NC_DOUBLE, {channel}, interval, "1"), std::move(half_width));
    keep(variable("albedo_standard_error", NC_DOUBLE, {channel}, "standard error", "1"), std::move(error));
  }

  void fill() const {
    std::string names;
    for (const auto& c : record_.image.channels)
      names += c.name + std::string(name_length_ - c.name.size(), '\0');
    require(late::nc_put_var_text(file_, names_, names.c_str()));
    for (const auto& [id, values] : doubles_) require(late::nc_put_var_double(file_, id, values.data()));
  }

  std::string path_;
  const RunRecord& record_;
  const ViewValues& values_;
  int file_ = -1, names_ = 0;
  std::size_t name_length_ = 1;
  std::vector<std::pair<int, std::vector<double>>> doubles_;
};

}  // namespace

void write_view_netcdf(const std::string& path, const RunRecord& record, const ViewValues& values) {
  const std::scoped_lock lock(netcdf_mutex());
  Writer(path, record, values).write();
}

}  // namespace ifov::io
