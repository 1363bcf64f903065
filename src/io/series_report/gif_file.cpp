#include "io/series_report/gif_file.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/error.h"

namespace ifov::io {
namespace {

int append_to_text(GifFileType* file, const GifByteType* bytes, int count) {
  static_cast<std::string*>(file->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return count;
}

struct FreeColours {
  void operator()(ColorMapObject* colours) const { GifFreeMapObject(colours); }
};
using Colours = std::unique_ptr<ColorMapObject, FreeColours>;

/// The library's tables have a power of two of colours.
Colours colours_of(const GifFile::Palette& palette) {
  constexpr int kColours = 256;
  Colours colours(GifMakeMapObject(kColours, nullptr));
  if (!colours) throw SystemError("there is no memory for an animation");
  for (std::size_t k = 0; k < kColours; ++k) {
    const Rgb colour = k < palette.size() ? palette[k] : Rgb{};
    colours->Colors[k] = {colour.r, colour.g, colour.b};
  }
  return colours;
}

[[noreturn]] void fail(int code) {
  const char* const reason = GifErrorString(code);
  throw SystemError(std::string("an animation cannot be made: ") +
                    (reason != nullptr ? reason : "giflib failed"));
}

}  // namespace

struct GifFile::Inside {
  std::string bytes;
  GifFileType* file = nullptr;
  ~Inside() {
    int ignored = 0;
    if (file != nullptr) EGifCloseFile(file, &ignored);
  }
  void must(int outcome) const {
    if (outcome != GIF_OK) fail(file->Error);
  }
};

GifFile::GifFile(int width, int height, const Palette& palette) : width_(width), height_(height) {
  auto inside = std::make_unique<Inside>();
  int error = 0;
  inside->file = EGifOpen(&inside->bytes, append_to_text, &error);
  if (inside->file == nullptr) fail(error);
  EGifSetGifVersion(inside->file, true);
  const Colours colours = colours_of(palette);
  inside->must(EGifPutScreenDesc(inside->file, width, height, 8, 0, colours.get()));
  // Begins again for ever, as browsers have it since Netscape 2.
  constexpr std::array<GifByteType, 3> kForEver{1, 0, 0};
  inside->must(EGifPutExtensionLeader(inside->file, APPLICATION_EXT_FUNC_CODE));
  inside->must(EGifPutExtensionBlock(inside->file, 11, "NETSCAPE2.0"));
  inside->must(EGifPutExtensionBlock(inside->file, static_cast<int>(kForEver.size()), kForEver.data()));
  inside->must(EGifPutExtensionTrailer(inside->file));
  inside_ = inside.release();
}

GifFile::~GifFile() { delete inside_; }

void GifFile::add(std::span<const std::uint8_t> frame, int hundredths_of_s) {
  int left = 0, right = width_, top = 0, bottom = height_;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
  };
  if (!before_.empty()) {
    left = width_, right = 0, top = height_, bottom = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        if (frame[at(x, y)] == before_[at(x, y)]) continue;
        left = std::min(left, x), right = std::max(right, x + 1);
        top = std::min(top, y), bottom = y + 1;
      }
    if (right <= left) left = 0, right = 1, top = 0, bottom = 1;  // the same again
  }
  const GraphicsControlBlock control{DISPOSE_DO_NOT, false, hundredths_of_s, NO_TRANSPARENT_COLOR};
  std::array<GifByteType, 4> coded{};
  EGifGCBToExtension(&control, coded.data());
  inside_->must(
      EGifPutExtension(inside_->file, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(coded.size()), coded.data()));
  inside_->must(EGifPutImageDesc(inside_->file, left, top, right - left, bottom - top, false, nullptr));
  std::vector<GifPixelType> line(static_cast<std::size_t>(right - left));
  for (int y = top; y < bottom; ++y) {
    std::copy_n(frame.begin() + static_cast<std::ptrdiff_t>(at(left, y)), line.size(), line.begin());
    inside_->must(EGifPutLine(inside_->file, line.data(), static_cast<int>(line.size())));
  }
  before_.assign(frame.begin(), frame.end());
}

std::string GifFile::finish() {
  GifFileType* const file = inside_->file;
  inside_->file = nullptr;
  int error = 0;
  if (EGifCloseFile(file, &error) != GIF_OK) fail(error);
  return std::move(inside_->bytes);
}

}  // namespace ifov::io
