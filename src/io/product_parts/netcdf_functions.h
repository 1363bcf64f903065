#pragma once

#include <netcdf.h>

#include "core/late_library.h"

/// The functions of netCDF that ifov calls. The library is loaded at the first call of one, and nothing is linked with it.
namespace ifov::io::late {

inline constinit LateLibrary netcdf{IFOV_LATE_NETCDF};

// What the compiler is told of a function beside its type (printf's formats) is not a part of the type.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wignored-attributes"
#define IFOV_NETCDF(name) inline constinit LateFunction<decltype(&::name)> name{netcdf, #name};
IFOV_NETCDF(nc_abort)
IFOV_NETCDF(nc_close)
IFOV_NETCDF(nc_create)
IFOV_NETCDF(nc_def_dim)
IFOV_NETCDF(nc_def_var)
IFOV_NETCDF(nc_enddef)
IFOV_NETCDF(nc_put_att_double)
IFOV_NETCDF(nc_put_att_float)
IFOV_NETCDF(nc_put_att_text)
IFOV_NETCDF(nc_put_var_double)
IFOV_NETCDF(nc_put_var_int)
IFOV_NETCDF(nc_put_var_text)
IFOV_NETCDF(nc_put_vara_float)
IFOV_NETCDF(nc_set_fill)
IFOV_NETCDF(nc_strerror)
#undef IFOV_NETCDF
#pragma GCC diagnostic pop

}  // namespace ifov::io::late
