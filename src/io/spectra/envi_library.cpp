#include "io/spectra/envi_library.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "core/names.h"
#include "io/envi/envi_header.h"
#include "io/envi/wavelength_unit.h"
#include "io/files/inputs.h"
#include "io/spectra/spectrum_bytes.h"
#include "io/tables/text_table.h"

namespace ifov::io {
namespace {

constexpr std::uintmax_t kLargestHeader = std::uintmax_t{64} << 20, kLargestData = std::uintmax_t{1} << 30;

std::vector<std::string> items_of(const std::string& list) {
  std::vector<std::string> items;
  for (const Field& field : split(list, ',')) {
    std::string item(field.text);
    std::replace_if(
        item.begin(), item.end(), [](char symbol) { return symbol == '\n' || symbol == '\r'; }, ' ');
    const std::size_t first = item.find_first_not_of(' ');
    items.push_back(first == std::string::npos ? std::string()
                                               : item.substr(first, item.find_last_not_of(' ') - first + 1));
  }
  return items;
}

const std::string* other(const EnviHeader& header, const std::string& key) {
  const auto found = header.other.find(key);
  return found == header.other.end() ? nullptr : &found->second;
}

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  throw InputError(format("{}: {}", file, message), {file, 0, 0});
}

/// Micrometres for each unit of the header's wavelengths.
double um_per_unit(const EnviHeader& header, const std::string& file) {
  const std::string& unit = header.wavelength_units;
  if (const std::optional<double> known = micrometres_per(unit)) return *known;
  if (unit.empty() || lower_case(unit) == "unknown")
    return *std::max_element(header.wavelength.begin(), header.wavelength.end()) < 100.0 ? 1.0 : 1e-3;
  fail(file,
       format("\"wavelength units\" is \"{}\"; expected Micrometers or Nanometers", header.wavelength_units));
}

template <class T>
double value_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (swapped) std::reverse(copy.begin(), copy.end());
  return static_cast<double>(std::bit_cast<T>(copy));
}

double value_at(const char* bytes, EnviType type, bool swapped) {
  switch (type) {
    case EnviType::byte: return value_at<std::uint8_t>(bytes, swapped);
    case EnviType::int16: return value_at<std::int16_t>(bytes, swapped);
    case EnviType::int32: return value_at<std::int32_t>(bytes, swapped);
    case EnviType::float64: return value_at<double>(bytes, swapped);
    case EnviType::uint16: return value_at<std::uint16_t>(bytes, swapped);
    case EnviType::uint32: return value_at<std::uint32_t>(bytes, swapped);
    case EnviType::float32: break;
  }
  return value_at<float>(bytes, swapped);
}

std::vector<bool> good_channels(const EnviHeader& header, const std::string& file) {
  std::vector<bool> good(static_cast<std::size_t>(header.samples), true);
  const std::string* list = other(header, "bbl");
  if (list == nullptr) return good;
  const std::vector<std::string> items = items_of(*list);
  if (items.size() != good.size())
    fail(file, format("\"bbl\" has {} items for {} channels", items.size(), good.size()));
  for (std::size_t i = 0; i < items.size(); ++i) good[i] = number_in(items[i]).value_or(0.0) > 0.0;
  return good;
}

double scale_factor(const EnviHeader& header, const std::string& file) {
  const std::string* text = other(header, "reflectance scale factor");
  if (text == nullptr) return 1.0;
  const std::optional<double> factor = number_in(*text);
  if (!factor || !(*factor > 0.0))
    fail(file, format("\"reflectance scale factor\" is \"{}\"; expected a number above 0", *text));
  return *factor;
}

std::vector<std::string> names_of(const EnviHeader& header, const std::string& file) {
  const std::string* list = other(header, "spectra names");
  std::vector<std::string> names = list == nullptr ? std::vector<std::string>() : items_of(*list);
  if (!names.empty() && names.back().empty()) names.pop_back();
  if (list != nullptr && names.size() != static_cast<std::size_t>(header.lines))
    fail(file, format("\"spectra names\" has {} items for {} spectra", names.size(), header.lines));
  for (int i = static_cast<int>(names.size()); i < header.lines; ++i) names.push_back(format("{}", i + 1));
  return names;
}

}  // namespace

EnviLibrary::EnviLibrary(std::string_view header_text, const std::string& header_name, std::string_view data,
                         const std::string& data_name)
    : file_(header_name) {
  const EnviHeader header = parse_envi_header(header_text, header_name);
  if (!header.is_spectral_library) fail(header_name, "\"file type\" is not \"ENVI Spectral Library\"");
  if (header.bands != 1)
    fail(header_name, format("\"bands\" is {}; expected 1 in a spectral library", header.bands));
  if (header.wavelength.empty()) fail(header_name, "the header has no \"wavelength\"");
  const std::size_t bytes = bytes_per_value(header.data_type);
  if (data.size() < header.header_offset || data.size() - header.header_offset < header.data_bytes())
    fail(data_name, format("the file has {} bytes; {} spectra of {} values need {}", data.size(),
                           header.lines, header.samples, header.header_offset + header.data_bytes()));
  names_ = names_of(header, header_name);
  const double unit = um_per_unit(header, header_name), scale = scale_factor(header, header_name);
  const std::vector<bool> good = good_channels(header, header_name);
  const bool swapped = header.big_endian != (std::endian::native == std::endian::big);
  const char* row = data.data() + header.header_offset;
  for (const std::string& name : names_) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < good.size(); ++i)
      if (good[i])
        points.emplace_back(header.wavelength[i] * unit,
                            value_at(row + i * bytes, header.data_type, swapped) / scale);
    std::sort(points.begin(), points.end());
    std::vector<double> wavelength_um, values;
    for (const auto& [wavelength, value] : points) {
      wavelength_um.push_back(wavelength);
      values.push_back(value);
    }
    try {
      spectra_.emplace_back(std::move(wavelength_um), std::move(values), radiometry::OutsideRange::error,
                            name);
    } catch (const InputError& error) {
      fail(header_name, format("the spectrum '{}': {}", name, error.what()));
    }
    row += good.size() * bytes;
  }
}

std::size_t EnviLibrary::index_of(const std::string& name) const {
  const auto count = std::count(names_.begin(), names_.end(), name);
  if (count > 1)
    throw InputError(format("{} spectra of '{}' are called '{}'; give a number", count, file_, name));
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  const std::string likely = did_you_mean(name, names_);
  throw InputError(format("no spectrum of '{}' is called '{}'{} {}", file_, name,
                          likely.empty() ? "; it holds" : likely + " It holds",
                          list_names(names_, "and", 12)));
}

std::size_t EnviLibrary::index_of(int number) const {
  if (number < 1 || number > static_cast<int>(names_.size()))
    throw InputError(format("'{}' has no spectrum {}; it holds 1 to {}", file_, number, names_.size()));
  return static_cast<std::size_t>(number - 1);
}

EnviLibrary read_envi_library(const std::filesystem::path& path) {
  const bool is_header = lower_case(path.extension().string()) == ".hdr";
  std::filesystem::path header = path, data = path;
  if (is_header) {
    data.replace_extension();
    for (const char* ending : {".sli", ".SLI", ".lib", ".img", ".dat"})
      if (!input_exists(data)) data = std::filesystem::path(path).replace_extension(ending);
    if (!input_exists(data)) throw SystemError(format("found no data beside the header '{}'", path.string()));
  } else {
    header.replace_extension(".hdr");
    if (!input_exists(header)) header = path.string() + ".hdr";
    if (!input_exists(header)) throw SystemError(format("found no header (.hdr) beside '{}'", path.string()));
  }
  return EnviLibrary(read_bytes(header, kLargestHeader), header.string(), read_bytes(data, kLargestData),
                     data.string());
}

}  // namespace ifov::io
