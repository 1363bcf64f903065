#include "io/product_parts/gdal_view.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <mutex>
#include <vector>

#include "core/error.h"
#include "io/raster/gdal_setup.h"

namespace ifov::io {
namespace {

// GDAL's classes of rasters are C++, which nothing here is linked with. What it can be given through C is a file: the view's values,
// band after band and line after line, under a name that only GDAL knows, and a virtual raster that says what lies where in it.

constexpr const char* kPrefix = "/vsiifov_view/";

/// The views that there are, by name.
class Views {
 public:
  std::string add(const RasterView& view) {
    const std::scoped_lock lock(mutex_);
    std::string name = format("{}{}", kPrefix, count_++);
    views_.emplace(name, &view);
    return name;
  }
  void remove(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    views_.erase(name);
  }
  const RasterView* find(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    const auto found = views_.find(name);
    return found == views_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, const RasterView*> views_;
  std::uint64_t count_ = 0;
};

Views& views() {
  static Views all;
  return all;
}

std::uint64_t line_bytes(const RasterView& view) {
  return sizeof(float) * static_cast<std::uint64_t>(view.width);
}

struct OpenView {
  const RasterView& view;
  std::vector<float> line{};
  std::uint64_t at = 0, number = ~std::uint64_t{0};  ///< the line that is held
  bool at_end = false;

  std::uint64_t lines() const {
    return static_cast<std::uint64_t>(view.height) * static_cast<std::uint64_t>(view.bands);
  }

  /// From the line that holds the byte `at` on, at most to its end; 0 at the end of the file.
  std::size_t copy(char* into, std::size_t bytes) {
    const std::uint64_t wanted = at / line_bytes(view), from = at % line_bytes(view);
    if (wanted >= lines()) return 0;
    if (wanted != number) {
      line.resize(static_cast<std::size_t>(view.width));
      number = ~std::uint64_t{0};
      const auto height = static_cast<std::uint64_t>(view.height);
      view.read(static_cast<int>(wanted % height), static_cast<int>(wanted / height), line);
      number = wanted;
    }
    const std::size_t got = std::min<std::size_t>(bytes, line_bytes(view) - from);
    std::memcpy(into, reinterpret_cast<const char*>(line.data()) + from, got);
    at += got;
    return got;
  }
};

void* open_view(void*, const char* name, const char* access) {
  if (std::strpbrk(access, "wa+") != nullptr) return nullptr;
  const RasterView* const view = views().find(std::string(kPrefix) + name);
  return view == nullptr ? nullptr : new OpenView{*view};
}

vsi_l_offset tell_view(void* file) { return static_cast<OpenView*>(file)->at; }

int seek_view(void* file, vsi_l_offset offset, int whence) {
  auto& open = *static_cast<OpenView*>(file);
  open.at = offset + (whence == SEEK_CUR   ? open.at
                      : whence == SEEK_END ? open.lines() * line_bytes(open.view)
                                           : 0);
  open.at_end = false;
  return 0;
}

std::size_t read_view(void* file, void* bytes, std::size_t size, std::size_t count) {
  auto& open = *static_cast<OpenView*>(file);
  std::size_t done = 0;
  try {
    while (done < size * count) {
      const std::size_t got = open.copy(static_cast<char*>(bytes) + done, size * count - done);
      open.at_end = got == 0;
      if (got == 0) break;
      done += got;
    }
  } catch (const std::exception& error) {
    late::CPLError(CE_Failure, CPLE_FileIO, "%s", error.what());
  }
  return size == 0 ? 0 : done / size;
}

int is_view_at_end(void* file) { return static_cast<OpenView*>(file)->at_end ? 1 : 0; }

int close_view(void* file) {
  delete static_cast<OpenView*>(file);
  return 0;
}

void install_views() {
  static std::once_flag once;
  std::call_once(once, [] {
    VSIFilesystemPluginCallbacksStruct* const calls = late::VSIAllocFilesystemPluginCallbacksStruct();
    calls->open = open_view;
    calls->tell = tell_view;
    calls->seek = seek_view;
    calls->read = read_view;
    calls->eof = is_view_at_end;
    calls->close = close_view;
    late::VSIInstallPluginHandler(kPrefix, calls);
    late::VSIFreeFilesystemPluginCallbacksStruct(calls);
  });
}

/// The virtual raster of a file of such a name; null where GDAL refuses.
Dataset virtual_raster(const RasterView& view, const std::string& name) {
  Dataset dataset(late::VRTCreate(view.width, view.height));
  const std::uint64_t band_bytes = line_bytes(view) * static_cast<std::uint64_t>(view.height);
  for (int band = 0; dataset && band < view.bands; ++band) {
    const std::string file = "SourceFilename=" + name,
                      offset = format("ImageOffset={}", band_bytes * static_cast<std::uint64_t>(band)),
                      line = format("LineOffset={}", line_bytes(view));
    const char* const options[] = {"subclass=VRTRawRasterBand",
                                   file.c_str(),
                                   "RelativeToVRT=false",
                                   offset.c_str(),
                                   "PixelOffset=4",
                                   line.c_str(),
                                   "ByteOrder=LSB",
                                   nullptr};
    if (late::GDALAddBand(dataset.get(), GDT_Float32, const_cast<char**>(options)) != CE_None)
      dataset.reset();
  }
  return dataset;
}

}  // namespace

GdalView::GdalView(const RasterView& view) {
  prepare_gdal();
  install_views();
  name_ = views().add(view);
  dataset_ = virtual_raster(view, name_);
  if (!dataset_) {
    views().remove(name_);
    throw SystemError(format("GDAL cannot be given an image to write: {}", late::CPLGetLastErrorMsg()));
  }
}

GdalView::~GdalView() {
  dataset_.reset();
  views().remove(name_);
}

}  // namespace ifov::io
