#include "io/products/netcdf.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/product_parts/channel_columns.h"
#include "io/product_parts/netcdf_file.h"
#include "io/product_parts/netcdf_map.h"
#include "io/product_parts/product_headers.h"
#include "io/quantities/quantity.h"
#include "io/quantities/quantity_set.h"
#include "io/raster/netcdf_lock.h"

namespace ifov::io {
namespace {

class Writer {
 public:
  Writer(const std::string& path, const std::vector<NetcdfCube>& input, const RunRecord& record)
      : file_(path, format_of(record.image)), input_(input), record_(record), info_(record.image) {}

  void write() {
    define();
    int before = 0;
    file_.require(late::nc_set_fill(file_.id(), NC_NOFILL, &before));
    file_.end_definition();
    write_coordinates();
    for (const auto& [variable, view] : cubes_) write_cube(variable, *view);
    file_.close();
  }

 private:
  static int format_of(const render::ImageInfo& info) {
    constexpr std::uint64_t kMostOfVariable = (std::uint64_t{1} << 32) - 4;
    const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(info.width_px) *
                                static_cast<std::uint64_t>(info.height_px) * info.channels.size();
    return bytes > kMostOfVariable ? NC_64BIT_DATA : NC_64BIT_OFFSET;
  }

  void define() {
    const std::array<int, 3> size{file_.dimension("wavelength", info_.channels.size()),
                                  file_.dimension("y", static_cast<std::size_t>(info_.height_px)),
                                  file_.dimension("x", static_cast<std::size_t>(info_.width_px))};
    file_.text(NC_GLOBAL, "Conventions", "CF-1.8");
    file_.text(NC_GLOBAL, "title", "synthetic radiance image");
    file_.text(NC_GLOBAL, "source",
               format("ifov {}, document {}, seed {}, sampler {}", record_.identity.version,
                      record_.identity.document_path, record_.identity.seed, record_.identity.sampler));
    if (!record_.outcome.accuracy_statement.empty())
      file_.text(NC_GLOBAL, "comment", record_.outcome.accuracy_statement);
    const std::string& time = record_.identity.acquisition.time;
    if (!time.empty())
      file_.text(NC_GLOBAL, "time_coverage_start", time), file_.text(NC_GLOBAL, "time_coverage_end", time);

    wavelength_ = file_.variable("wavelength", NC_DOUBLE, {size[0]});
    file_.text(wavelength_, "standard_name", "radiation_wavelength");
    file_.text(wavelength_, "long_name", "centre of the channel");
    file_.text(wavelength_, "units", "um");
    fwhm_ = file_.variable("fwhm", NC_DOUBLE, {size[0]}, "full width of the channel at half maximum", "um");
    define_names(size[0]);
    define_columns(size[0], size[2]);
    if (info_.has_map) map_.emplace(NetcdfMap::define(file_.id(), size[1], size[2], info_));
    std::string others;
    for (const NetcdfCube& cube : input_) {
      define_cube(*cube.quantity, cube.view, size);
      if (&cube != &input_.front()) others += format("{}{}", others.empty() ? "" : " ", cube.quantity->name);
    }
    if (!others.empty()) file_.text(cubes_.front().first, "ancillary_variables", others);
  }

  void define_names(int wavelength_size) {
    for (const auto& channel : info_.channels) names_.push_back(channel.name);
    const int length = file_.dimension("name_length", name_length(names_));
    name_ = file_.variable("channel", NC_CHAR, {wavelength_size, length}, "name of the channel", "");
  }

  /// What detector columns differ in.
  void define_columns(int wavelength_size, int x_size) {
    const auto define = [&](const auto& values, const char* name, const char* what, const char* unit) {
      if (values.empty()) return;
      by_column_.emplace_back(file_.variable(name, NC_DOUBLE, {wavelength_size, x_size}, what, unit),
                              &values);
    };
    define(columns_.centre_um, "wavelength_by_column", "centre of the channel in a column of the detector",
           "um");
    define(columns_.fwhm_um, "fwhm_by_column",
           "full width of the channel at half maximum in a column of the detector", "um");
    define(columns_.shift_px, "shift_by_column",
           "how far to the right of an element what it sees lies, in pixels", "1");
  }

  void define_cube(const Quantity& quantity, const RasterView& view, const std::array<int, 3>& size) {
    const bool stokes = quantity.bands == Quantity::Bands::stokes;
    std::vector<int> dimensions(size.begin(), size.end());
    if (stokes) dimensions.insert(dimensions.begin(), stokes_size());
    const int id = file_.variable(std::string(quantity.name), NC_FLOAT, dimensions);
    const float gap = std::numeric_limits<float>::quiet_NaN();
    file_.require(late::nc_put_att_float(file_.id(), id, "_FillValue", NC_FLOAT, 1, &gap));
    file_.text(id, "long_name", std::string(quantity.what));
    if (quantity.statistic == Quantity::Statistic::half_width)
      file_.text(id, "comment", format("of the {:g} % interval", 100.0 * record_.identity.confidence));
    file_.text(id, "units",
               quantity.unit.empty()    ? info_.radiance_unit
               : quantity.unit == "deg" ? "degree"
                                        : std::string(quantity.unit));
    if (quantity.needs.stokes) file_.text(id, "stokes_convention", stokes_convention());
    file_.text(id, "coordinates", stokes ? "fwhm channel stokes_component" : "fwhm channel");
    if (map_ && map_->has_system()) file_.text(id, "grid_mapping", NetcdfMap::kName);
    cubes_.emplace_back(id, &view);
  }

  /// The dimension of I, Q, U and V, made where it is needed.
  int stokes_size() {
    if (stokes_dimension_ >= 0) return stokes_dimension_;
    stokes_dimension_ = file_.dimension("stokes", 4);
    stokes_ = file_.variable("stokes_component", NC_CHAR, {stokes_dimension_},
                             "component of the Stokes vector", "");
    return stokes_dimension_;
  }

  void write_coordinates() const {
    if (stokes_dimension_ >= 0) file_.require(late::nc_put_var_text(file_.id(), stokes_, "IQUV"));
    std::vector<double> centres, widths;
    for (const auto& channel : info_.channels) {
      centres.push_back(channel.centre_um);
      widths.push_back(channel.fwhm_um);
    }
    file_.put(wavelength_, centres);
    file_.put(fwhm_, widths);
    file_.put(name_, names_);
    for (const auto& [variable, values] : by_column_) {
      std::vector<double> all;
      for (const std::vector<double>& row : *values) all.insert(all.end(), row.begin(), row.end());
      file_.put(variable, all);
    }
    if (map_) map_->write(file_.id(), info_);
  }

  /// Some lines of all bands at a time: cubes are read as they lie by line or by pixel, and the file gets pieces of several lines.
  void write_cube(int variable, const RasterView& view) const {
    constexpr std::size_t kMostValues = std::size_t{16} << 20;  // 64 MiB
    const auto width = static_cast<std::size_t>(view.width), bands = static_cast<std::size_t>(view.bands),
               channels = info_.channels.size();
    const int at_once = static_cast<int>(
        std::clamp<std::size_t>(kMostValues / (width * bands), 1, static_cast<std::size_t>(view.height)));
    std::vector<float> block(width * bands * static_cast<std::size_t>(at_once));
    for (int first = 0; first < view.height; first += at_once) {
      const auto lines = static_cast<std::size_t>(std::min(at_once, view.height - first));
      for (std::size_t y = 0; y < lines; ++y)
        for (std::size_t band = 0; band < bands; ++band)
          view.read(first + static_cast<int>(y), static_cast<int>(band),
                    std::span(block).subspan((band * lines + y) * width, width));
      for (std::size_t band = 0; band < bands; ++band) {
        // Of a Stokes vector the component is one more dimension, before all others.
        const std::size_t start[] = {band / channels, band % channels, static_cast<std::size_t>(first), 0},
                          count[] = {1, 1, lines, width};
        const bool stokes = bands > channels;
        file_.require(late::nc_put_vara_float(file_.id(), variable, stokes ? start : start + 1,
                                              stokes ? count : count + 1, &block[band * lines * width]));
      }
    }
  }

  NetcdfFile file_;
  const std::vector<NetcdfCube>& input_;
  const RunRecord& record_;
  const render::ImageInfo& info_;
  int wavelength_ = 0, fwhm_ = 0, name_ = 0, stokes_ = 0, stokes_dimension_ = -1;
  std::vector<std::string> names_;
  std::optional<NetcdfMap> map_;
  std::vector<std::pair<int, const RasterView*>> cubes_;
  const ChannelsByColumn columns_ = channels_by_column(info_);
  std::vector<std::pair<int, const std::vector<std::vector<double>>*>> by_column_;
};

}  // namespace

std::uint64_t netcdf_bytes(const render::ImageInfo& image, const QuantitySet& quantities) {
  std::uint64_t bytes = 0;
  for (const Quantity* quantity : possible_quantities(quantities, image))
    if (quantity->is_spectral() || quantity->bands == Quantity::Bands::stokes)
      bytes += cube_size(*quantity, image).bytes();
  return bytes;
}

void write_netcdf(PartFile& file, const std::vector<NetcdfCube>& input, const RunRecord& record) {
  std::uint64_t bytes = 0;
  for (const NetcdfCube& cube : input) bytes += cube_size(*cube.quantity, record.image).bytes();
  require_space(file.part_path().parent_path(), bytes);
  const std::scoped_lock lock(netcdf_mutex());
  Writer(file.part_path().string(), input, record).write();
}

constinit const ProductFormat formats::kNetcdf{
    .name = "netcdf",
    .ending = "_radiance.nc",
    .what = "radiance and its errors, NetCDF",
    .write =
        [](PartFile& file, const FormatInput& input) {
          std::vector<NetcdfCube> by_channel;
          for (const Quantity* quantity : all_quantities())
            if (const RasterView view = input.values_of(*quantity);
                view && (quantity->is_spectral() || quantity->bands == Quantity::Bands::stokes))
              by_channel.push_back({quantity, view});
          write_netcdf(file, by_channel, input.record);
        },
    .suits = is_picture,
    .bytes = netcdf_bytes};

}  // namespace ifov::io
