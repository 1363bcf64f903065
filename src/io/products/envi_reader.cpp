#include "io/products/envi_reader.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "core/error.h"
#include "core/parallel.h"
#include "io/envi/cube_layout.h"

namespace ifov::io {
namespace {

constexpr std::uintmax_t kLargestHeader = std::uintmax_t{64} << 20;

std::filesystem::path find_header(const std::filesystem::path& data) {
  std::filesystem::path appended = data, replaced = data;
  appended += ".hdr";
  replaced.replace_extension(".hdr");
  for (const auto& candidate : {appended, replaced})
    if (std::filesystem::is_regular_file(candidate)) return candidate;
  throw SystemError(format("{}: no ENVI header beside it: neither {} nor {} exists", data.string(),
                           appended.filename().string(), replaced.filename().string()));
}

std::filesystem::path find_data(const std::filesystem::path& header) {
  std::filesystem::path stem = header;
  stem.replace_extension();
  for (const char* extension : {"", ".img", ".dat", ".bil", ".bsq", ".bip", ".raw"}) {
    std::filesystem::path candidate = stem;
    candidate += extension;
    if (std::filesystem::is_regular_file(candidate)) return candidate;
  }
  throw SystemError(format("{}: no data file beside the header", header.string()));
}

std::string read_text(const std::filesystem::path& path) {
  const InputFile file(path);
  if (file.size() > kLargestHeader)
    throw InputError(format("{}: too large for an ENVI header", path.string()));
  return file.text();
}

template <class T>
double value_at(const unsigned char* bytes, bool swap) {
  unsigned char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if (swap) std::reverse(copy, copy + sizeof(T));
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return static_cast<double>(value);
}

double (*converter(EnviType type))(const unsigned char*, bool) {
  switch (type) {
    case EnviType::byte: return value_at<std::uint8_t>;
    case EnviType::int16: return value_at<std::int16_t>;
    case EnviType::int32: return value_at<std::int32_t>;
    case EnviType::float64: return value_at<double>;
    case EnviType::uint16: return value_at<std::uint16_t>;
    case EnviType::uint32: return value_at<std::uint32_t>;
    case EnviType::float32: break;
  }
  return value_at<float>;
}

void fetch(const InputFile& file, const std::filesystem::path& path, std::uint64_t offset, void* to,
           std::size_t bytes) {
  if (file.read_at(offset, {static_cast<char*>(to), bytes}) < bytes)
    throw SystemError(format("{}: cannot be read: the file ends", path.string()));
}

}  // namespace

EnviReader::Pair EnviReader::pair_of(const std::filesystem::path& path) {
  if (path.extension() == ".hdr") return {path, find_data(path)};
  return {find_header(path), path};
}

EnviReader::EnviReader(const std::filesystem::path& path) : EnviReader(pair_of(path)) {}

EnviReader::EnviReader(const Pair& pair)
    : header_(parse_envi_header(read_text(pair.header), pair.header.string())),
      data_path_(pair.data),
      data_(std::make_shared<const InputFile>(pair.data)) {
  const std::uint64_t needed = header_.header_offset + header_.data_bytes();
  if (data_->size() < needed)
    throw SystemError(format("{}: the file has {} bytes, its header {} asks for {}", data_path_.string(),
                             data_->size(), pair.header.filename().string(), needed));
  // Those who read whole lines band by band, a line on each thread, would read each line as often as it has bands.
  constexpr std::size_t kKeptBytes = std::size_t{16} << 20;
  if (header_.interleave == EnviInterleave::bip && header_.bands > 1)
    turned_ = std::make_unique<TurnedLines>(
        header_.samples, header_.bands, bytes_per_value(header_.data_type),
        [data = data_, path = data_path_, first = header_.header_offset](std::uint64_t offset, void* to,
                                                                         std::size_t bytes) {
          fetch(*data, path, first + offset, to, bytes);
        },
        kKeptBytes, static_cast<std::size_t>(usual_threads()));
}

std::uint64_t EnviReader::place(int sample, int line, int band) const {
  if (sample < 0 || sample >= header_.samples || line < 0 || line >= header_.lines || band < 0 ||
      band >= header_.bands)
    throw std::out_of_range(
        format("{}: there is no sample {}, line {}, band {}", data_path_.string(), sample, line, band));
  return header_.header_offset +
         bytes_per_value(header_.data_type) * layout_of(header_).place(sample, line, band);
}

void EnviReader::read(int line, int band, std::span<float> values, int first) const {
  if (values.empty()) return;
  const std::uint64_t begin = place(first, line, band);
  values = values.first(std::min(values.size(), static_cast<std::size_t>(header_.samples - first)));
  const std::size_t size = bytes_per_value(header_.data_type);
  const auto convert = converter(header_.data_type);
  if (turned_ && values.size() == static_cast<std::size_t>(header_.samples)) {
    const TurnedLines::Line bands = turned_->line(line);
    const auto* const from = reinterpret_cast<const unsigned char*>(bands->data()) +
                             static_cast<std::size_t>(band) * values.size() * size;
    for (std::size_t x = 0; x < values.size(); ++x)
      values[x] = static_cast<float>(convert(from + x * size, header_.big_endian));
    return;
  }
  const std::size_t step =
      header_.interleave == EnviInterleave::bip ? static_cast<std::size_t>(header_.bands) : 1;
  std::vector<unsigned char> raw(((values.size() - 1) * step + 1) * size);
  fetch(*data_, data_path_, begin, raw.data(), raw.size());
  for (std::size_t x = 0; x < values.size(); ++x)
    values[x] = static_cast<float>(convert(raw.data() + x * step * size, header_.big_endian));
}

std::vector<double> EnviReader::pixel(int sample, int line) const {
  const std::size_t size = bytes_per_value(header_.data_type);
  const auto convert = converter(header_.data_type);
  std::vector<double> values;
  for (int band = 0; band < header_.bands; ++band) {
    unsigned char raw[8];
    fetch(*data_, data_path_, place(sample, line, band), raw, size);
    values.push_back(convert(raw, header_.big_endian));
  }
  return values;
}

RasterView EnviReader::view() const {
  return {header_.samples, header_.lines, header_.bands,
          [this](int line, int band, std::span<float> values) { read(line, band, values); }};
}

}  // namespace ifov::io
