#include "io/raster/netcdf_variable.h"

#include <functional>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "core/format.h"
#include "io/files/input_file.h"
#include "io/raster/gdal_functions.h"
#include "io/raster/gdal_setup.h"
#include "io/raster/netcdf_lock.h"
#include "io/raster/quiet_gdal.h"

namespace ifov::io {

NetcdfVariable read_netcdf_variable(const std::filesystem::path& path, const std::string& name) {
  const InputFile readable(path);  // the library opens the file itself
  const QuietGdal quiet;
  prepare_gdal();
  const char* drivers[] = {"netCDF", nullptr};
  const std::scoped_lock lock(netcdf_mutex());
  const std::unique_ptr<void, decltype(&GDALClose)> dataset(
      late::GDALOpenEx(path.c_str(), GDAL_OF_MULTIDIM_RASTER, drivers, nullptr, nullptr), late::GDALClose);
  if (!dataset)
    throw InputError(format("{}: cannot be read: {}", path.string(), quiet.message()), {path.string(), 0, 0});
  const std::unique_ptr<GDALGroupHS, decltype(&GDALGroupRelease)> root(
      late::GDALDatasetGetRootGroup(dataset.get()), late::GDALGroupRelease);
  const std::unique_ptr<GDALMDArrayHS, decltype(&GDALMDArrayRelease)> array(
      root ? late::GDALGroupOpenMDArray(root.get(), name.c_str(), nullptr) : nullptr,
      late::GDALMDArrayRelease);
  if (!array)
    throw InputError(format("{}: there is no variable '{}'", path.string(), name), {path.string(), 0, 0});
  NetcdfVariable variable;
  std::size_t count = 0;
  GDALDimensionHS** dimensions = late::GDALMDArrayGetDimensions(array.get(), &count);
  for (std::size_t k = 0; k < count; ++k)
    variable.dimensions.push_back(late::GDALDimensionGetSize(dimensions[k]));
  late::GDALReleaseDimensions(dimensions, count);
  variable.values.resize(std::accumulate(variable.dimensions.begin(), variable.dimensions.end(),
                                         std::size_t{1}, std::multiplies<>()));
  const std::vector<GUInt64> start(count, 0);
  const std::unique_ptr<GDALExtendedDataTypeHS, decltype(&GDALExtendedDataTypeRelease)> type(
      late::GDALExtendedDataTypeCreate(GDT_Float64), late::GDALExtendedDataTypeRelease);
  if (late::GDALMDArrayRead(array.get(), start.data(), variable.dimensions.data(), nullptr, nullptr,
                            type.get(), variable.values.data(), variable.values.data(),
                            8 * variable.values.size()) == 0)
    throw InputError(format("{}: '{}' cannot be read: {}", path.string(), name, quiet.message()),
                     {path.string(), 0, 0});
  return variable;
}

}  // namespace ifov::io
