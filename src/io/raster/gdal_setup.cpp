#include "io/raster/gdal_setup.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <string_view>

#include "core/error.h"
#include "io/files/input_file.h"
#include "io/raster/gdal_functions.h"

namespace ifov::io {
namespace {

constexpr std::string_view kPrefix = "/vsiifov/";
constexpr GIntBig kCache_bytes = GIntBig{64} << 20;

#define IFOV_DRIVER(name) reinterpret_cast<Register>(late::gdal.function("GDALRegister_" #name)),
using Register = decltype(&::GDALRegister_GTiff);
void register_drivers() {
  for (const auto register_one : {// read and written
                                  IFOV_DRIVER(GTiff) IFOV_DRIVER(COG) IFOV_DRIVER(PNG) IFOV_DRIVER(MEM)
                                  // read
                                  IFOV_RASTER_DRIVERS IFOV_DRIVER(netCDF)})
    register_one();
  // Virtual rasters are made (gdal_view) and never opened: they could name any file. Their maker registers their driver, but for
  // where there is one of its name, such as this, which opens nothing.
  const GDALDriverH nothing = late::GDALCreateDriver();
  late::GDALSetDescription(nothing, "VRT");
  late::GDALRegisterDriver(nothing);
}
#undef IFOV_DRIVER

struct OpenFile {
  InputFile file;
  std::uint64_t at = 0;
  bool at_end = false;
};

// GDAL takes the prefix off the names that it gives to these.

int look_at(void*, const char* name, VSIStatBufL* info, int) {
  try {
    const InputFile file(name);
    if (!file.memory()) return fstat64(file.descriptor(), info);
    *info = {};
    info->st_mode = S_IFREG;
    info->st_size = static_cast<off_t>(file.size());
    return 0;
  } catch (const SystemError&) {
    return -1;
  } catch (const InputError&) {  // no such asset
    return -1;
  }
}

void* open_input(void*, const char* name, const char* access) {
  if (std::string_view(access).find_first_of("wa+") != std::string_view::npos) return nullptr;
  try {
    return new OpenFile{InputFile(name)};
  } catch (const SystemError&) {
    return nullptr;
  } catch (const InputError&) {
    return nullptr;
  }
}

vsi_l_offset tell(void* file) { return static_cast<OpenFile*>(file)->at; }

int seek(void* file, vsi_l_offset offset, int whence) {
  auto& open = *static_cast<OpenFile*>(file);
  open.at = offset + (whence == SEEK_CUR ? open.at : whence == SEEK_END ? open.file.size() : 0);
  open.at_end = false;
  return 0;
}

std::size_t read(void* file, void* bytes, std::size_t size, std::size_t count) {
  auto& open = *static_cast<OpenFile*>(file);
  if (size == 0 || count == 0) return 0;
  if (count > SIZE_MAX / size) return 0;
  try {
    const std::size_t got = open.file.read_at(open.at, {static_cast<char*>(bytes), size * count});
    open.at_end = got < size * count;
    open.at += got;
    return got / size;
  } catch (const SystemError&) {
    return 0;
  } catch (const Cancelled&) {  // the file is damaged, then; who reads it asks why
    return 0;
  }
}

int is_at_end(void* file) { return static_cast<OpenFile*>(file)->at_end ? 1 : 0; }

int close_input(void* file) {
  delete static_cast<OpenFile*>(file);
  return 0;
}

void install_inputs() {
  VSIFilesystemPluginCallbacksStruct* const calls = late::VSIAllocFilesystemPluginCallbacksStruct();
  calls->stat = look_at;
  calls->open = open_input;
  calls->tell = tell;
  calls->seek = seek;
  calls->read = read;
  calls->eof = is_at_end;
  calls->close = close_input;
  late::VSIInstallPluginHandler(kPrefix.data(), calls);  // keeps the address of the prefix
  late::VSIFreeFilesystemPluginCallbacksStruct(calls);
}

}  // namespace

void prepare_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    register_drivers();
    install_inputs();
    late::OSRSetPROJEnableNetwork(FALSE);
    late::GDALSetCacheMax64(kCache_bytes);
  });
}

std::string gdal_input_name(const std::filesystem::path& path) {
  return std::string(kPrefix) + path.string();
}

std::string without_input_prefix(std::string message) {
  for (std::size_t at = 0; (at = message.find(kPrefix, at)) != std::string::npos;)
    message.erase(at, kPrefix.size());
  return message;
}

NoSidecars::NoSidecars() { late::CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO"); }
NoSidecars::~NoSidecars() { late::CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr); }

}  // namespace ifov::io
