#include "io/products/netcdf.h"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/product_parts/netcdf_functions.h"
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
      : path_(path), input_(input), record_(record), info_(record.image) {
    constexpr std::uint64_t kMostOfVariable = (std::uint64_t{1} << 32) - 4;
    const std::uint64_t bytes = 4 * static_cast<std::uint64_t>(info_.width_px) *
                                static_cast<std::uint64_t>(info_.height_px) * info_.channels.size();
    require(late::nc_create(
        path.c_str(), NC_CLOBBER | (bytes > kMostOfVariable ? NC_64BIT_DATA : NC_64BIT_OFFSET), &file_));
  }
  ~Writer() {
    if (file_ >= 0) late::nc_abort(file_);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void write() {
    define();
    int before = 0;
    require(late::nc_set_fill(file_, NC_NOFILL, &before));
    require(late::nc_enddef(file_));
    write_coordinates();
    for (const auto& [variable, view] : cubes_) write_cube(variable, *view);
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
  int variable(const char* name, nc_type type, const std::vector<int>& dimensions) const {
    int id = 0;
    require(late::nc_def_var(file_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
    return id;
  }

  void define() {
    std::array<int, 3> size{};  // wavelength, y, x
    require(late::nc_def_dim(file_, "wavelength", info_.channels.size(), &size[0]));
    require(late::nc_def_dim(file_, "y", static_cast<std::size_t>(info_.height_px), &size[1]));
    require(late::nc_def_dim(file_, "x", static_cast<std::size_t>(info_.width_px), &size[2]));
    text(NC_GLOBAL, "Conventions", "CF-1.8");
    text(NC_GLOBAL, "title", "synthetic radiance image");
    text(NC_GLOBAL, "source",
         format("ifov {}, document {}, seed {}, sampler {}", record_.identity.version,
                record_.identity.document_path, record_.identity.seed, record_.identity.sampler));
    if (!record_.outcome.accuracy_statement.empty())
      text(NC_GLOBAL, "comment", record_.outcome.accuracy_statement);
    const std::string& time = record_.identity.acquisition.time;
    if (!time.empty())
      text(NC_GLOBAL, "time_coverage_start", time), text(NC_GLOBAL, "time_coverage_end", time);

    wavelength_ = variable("wavelength", NC_DOUBLE, {size[0]});
    text(wavelength_, "standard_name", "radiation_wavelength");
    text(wavelength_, "long_name", "centre of the channel");
    text(wavelength_, "units", "um");
    fwhm_ = variable("fwhm", NC_DOUBLE, {size[0]});
    text(fwhm_, "long_name", "full width of the channel at half maximum");
    text(fwhm_, "units", "um");
    define_names(size[0]);
    if (info_.has_map) map_.emplace(NetcdfMap::define(file_, size[1], size[2], info_));
    std::string others;
    for (const NetcdfCube& cube : input_) {
      define_cube(*cube.quantity, cube.view, size);
      if (&cube != &input_.front()) others += format("{}{}", others.empty() ? "" : " ", cube.quantity->name);
    }
    if (!others.empty()) text(cubes_.front().first, "ancillary_variables", others);
  }

  void define_names(int wavelength_size) {
    for (const auto& channel : info_.channels) name_length_ = std::max(name_length_, channel.name.size());
    int length = 0;
    require(late::nc_def_dim(file_, "name_length", name_length_, &length));
    name_ = variable("channel", NC_CHAR, {wavelength_size, length});
    text(name_, "long_name", "name of the channel");
  }

  void define_cube(const Quantity& quantity, const RasterView& view, const std::array<int, 3>& size) {
    const bool stokes = quantity.bands == Quantity::Bands::stokes;
    std::vector<int> dimensions(size.begin(), size.end());
    if (stokes) dimensions.insert(dimensions.begin(), stokes_size());
    const int id = variable(std::string(quantity.name).c_str(), NC_FLOAT, dimensions);
    const float gap = std::numeric_limits<float>::quiet_NaN();
    require(late::nc_put_att_float(file_, id, "_FillValue", NC_FLOAT, 1, &gap));
    text(id, "long_name", std::string(quantity.what));
    if (quantity.statistic == Quantity::Statistic::half_width)
      text(id, "comment", format("of the {:g} % interval", 100.0 * record_.identity.confidence));
    text(id, "units",
         quantity.unit.empty()    ? info_.radiance_unit
         : quantity.unit == "deg" ? "degree"
                                  : std::string(quantity.unit));
    if (quantity.needs.stokes) text(id, "stokes_convention", stokes_convention());
    text(id, "coordinates", stokes ? "fwhm channel stokes_component" : "fwhm channel");
    if (map_ && map_->has_system()) text(id, "grid_mapping", NetcdfMap::kName);
    cubes_.emplace_back(id, &view);
  }

  /// The dimension of I, Q, U and V, made where it is needed.
  int stokes_size() {
    if (stokes_dimension_ >= 0) return stokes_dimension_;
    require(late::nc_def_dim(file_, "stokes", 4, &stokes_dimension_));
    stokes_ = variable("stokes_component", NC_CHAR, {stokes_dimension_});
    text(stokes_, "long_name", "component of the Stokes vector");
    return stokes_dimension_;
  }

  void write_coordinates() const {
    if (stokes_dimension_ >= 0) require(late::nc_put_var_text(file_, stokes_, "IQUV"));
    std::vector<double> centres, widths;
    std::string names;
    for (const auto& channel : info_.channels) {
      centres.push_back(channel.centre_um);
      widths.push_back(channel.fwhm_um);
      names += channel.name + std::string(name_length_ - channel.name.size(), '\0');
    }
    require(late::nc_put_var_double(file_, wavelength_, centres.data()));
    require(late::nc_put_var_double(file_, fwhm_, widths.data()));
    require(late::nc_put_var_text(file_, name_, names.c_str()));
    if (map_) map_->write(file_, info_);
  }

  void write_cube(int variable, const RasterView& view) const {
    std::vector<float> line(static_cast<std::size_t>(view.width));
    for (int band = 0; band < view.bands; ++band)
      for (int y = 0; y < view.height; ++y) {
        view.read(y, band, line);
        const std::size_t channels = info_.channels.size(), at = static_cast<std::size_t>(band);
        // Of a Stokes vector the component is one more dimension, before all others.
        const std::size_t start[] = {at / channels, at % channels, static_cast<std::size_t>(y), 0},
                          count[] = {1, 1, 1, line.size()};
        const bool stokes = static_cast<std::size_t>(view.bands) > channels;
        require(late::nc_put_vara_float(file_, variable, stokes ? start : start + 1,
                                        stokes ? count : count + 1, line.data()));
      }
  }

  std::string path_;
  const std::vector<NetcdfCube>& input_;
  const RunRecord& record_;
  const render::ImageInfo& info_;
  int file_ = -1, wavelength_ = 0, fwhm_ = 0, name_ = 0, stokes_ = 0, stokes_dimension_ = -1;
  std::size_t name_length_ = 1;
  std::optional<NetcdfMap> map_;
  std::vector<std::pair<int, const RasterView*>> cubes_;
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
