#include "io/spectra/asd.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "io/spectra/spectrum_bytes.h"

namespace ifov::io {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

// Where the header's fields stand.
constexpr std::size_t kHeaderBytes = 484, kDataType = 186, kFirstNm = 191, kStepNm = 195, kDataFormat = 199,
                      kChannels = 204;
constexpr std::uintmax_t kLargestBytes = std::uintmax_t{64} << 20;

enum class DataType {
  raw,
  reflectance,
  radiance,
  no_units,
  irradiance,
  quality,
  transmittance,
  unknown,
  absorbance
};
constexpr std::array<const char*, 9> kDataTypes{"raw counts",    "reflectance",     "radiance",
                                                "no units",      "irradiance",      "a quality index",
                                                "transmittance", "an unknown type", "absorbance"};

class Bytes {
 public:
  Bytes(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(format("{}: {}", name_, message), {name_, 0, 0});
  }

  template <class T>
  T at(std::size_t offset) const {
    if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T))
      fail(format("the file ends at byte {}; expected a number at byte {}", bytes_.size(), offset));
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof(T));
    return value;
  }

  std::size_t size() const { return bytes_.size(); }
  std::string_view text(std::size_t offset, std::size_t length) const {
    return bytes_.substr(offset, length);
  }

 private:
  std::string_view bytes_;
  const std::string& name_;
};

std::size_t bytes_of(const Bytes& file, int format_code) {
  switch (format_code) {
    case 0:  // float
    case 1:  // 32-bit integer
      return 4;
    case 2:  // double
      return 8;
    default:
      file.fail(
          format("the format of its data is {}; expected 0 (float), 1 (integer) or 2 (double)", format_code));
  }
}

std::vector<double> read_values(const Bytes& file, std::size_t offset, std::size_t count, int format_code) {
  const std::size_t bytes = bytes_of(file, format_code);
  if (offset > file.size() || file.size() - offset < count * bytes)
    file.fail(format("the file ends at byte {}; expected {} values of {} bytes from byte {} on", file.size(),
                     count, bytes, offset));
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = offset + i * bytes;
    values[i] = format_code == 0   ? static_cast<double>(file.at<float>(at))
                : format_code == 1 ? static_cast<double>(file.at<std::int32_t>(at))
                                   : file.at<double>(at);
  }
  return values;
}

/// The white reference behind the spectrum; empty where the file has none.
std::vector<double> read_reference(const Bytes& file, std::size_t offset, std::size_t count,
                                   int format_code) {
  constexpr std::size_t kBeforeText = 2 + 8 + 8;  // flag, time of the reference, time of the spectrum
  if (file.size() < offset + kBeforeText + 2 || file.at<std::uint16_t>(offset) == 0) return {};
  const std::size_t text = file.at<std::uint16_t>(offset + kBeforeText);
  return read_values(file, offset + kBeforeText + 2 + text, count, format_code);
}

int version_of(const Bytes& file) {
  const std::string_view word = file.text(0, 3);
  if (word == "ASD") return 1;
  if (word.size() == 3 && word.substr(0, 2) == "as" && word[2] >= '2' && word[2] <= '8') return word[2] - '0';
  file.fail("it does not start as a file of an ASD spectrometer does ('ASD', 'as2' to 'as8')");
}

}  // namespace

SampleSpectrum parse_asd(std::string_view bytes, const std::string& name) {
  const Bytes file(bytes, name);
  const int version = version_of(file);
  const std::size_t channels = file.at<std::uint16_t>(kChannels);
  const double first_nm = static_cast<double>(file.at<float>(kFirstNm)),
               step_nm = static_cast<double>(file.at<float>(kStepNm));
  const int format_code = file.at<std::uint8_t>(kDataFormat), type_code = file.at<std::uint8_t>(kDataType);
  if (channels < 2) file.fail(format("it states {} channels; expected at least 2", channels));
  if (!std::isfinite(first_nm) || !std::isfinite(step_nm) || first_nm <= 0.0 || step_nm <= 0.0)
    file.fail(format("its wavelengths start at {:g} nm in steps of {:g} nm; expected numbers above 0",
                     first_nm, step_nm));
  if (type_code >= static_cast<int>(kDataTypes.size()))
    file.fail(format("the type of its data is {}; expected 0 to {}", type_code, kDataTypes.size() - 1));
  const DataType type = static_cast<DataType>(type_code);
  if (type != DataType::raw && type != DataType::reflectance && type != DataType::transmittance)
    file.fail(format("it holds {}; expected reflectance, transmittance, or raw counts with a white reference",
                     kDataTypes[static_cast<std::size_t>(type_code)]));

  std::vector<double> values = read_values(file, kHeaderBytes, channels, format_code);
  const std::vector<double> reference =
      version == 1 ? std::vector<double>()
                   : read_reference(file, kHeaderBytes + channels * bytes_of(file, format_code), channels,
                                    format_code);
  if (reference.empty() && type == DataType::raw) file.fail("it holds raw counts and no white reference");
  std::vector<double> wavelength_um(channels);
  for (std::size_t i = 0; i < channels; ++i) {
    wavelength_um[i] = 1e-3 * (first_nm + step_nm * static_cast<double>(i));
    if (!reference.empty()) values[i] /= reference[i];
    if (!std::isfinite(values[i]))
      file.fail(format("its value at {:g} um is not a finite number", wavelength_um[i]));
  }
  const std::string title = std::filesystem::path(name).filename().string();
  return {title,
          type == DataType::transmittance ? SampleQuantity::transmittance : SampleQuantity::reflectance,
          radiometry::Spectrum(std::move(wavelength_um), std::move(values), radiometry::OutsideRange::error,
                               title)};
}

SampleSpectrum read_asd(const std::filesystem::path& path) {
  return parse_asd(read_bytes(path, kLargestBytes), path.string());
}

}  // namespace ifov::io
