#include "io/envi/envi_header.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>

#include "core/error.h"
#include "io/envi/cube_layout.h"

namespace ifov::io {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 60;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> items;
  if (trimmed(list).empty()) return items;
  while (true) {
    const auto comma = list.find(',');
    items.emplace_back(trimmed(list.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    list.remove_prefix(comma + 1);
  }
  if (items.back().empty()) items.pop_back();  // "{a, b,}" is common
  return items;
}

struct Entry {
  std::string value;
  int line = 0;
};

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : file_(file) { read_entries(text); }

  EnviHeader header() {
    EnviHeader result;
    result.samples = size("samples");
    result.lines = size("lines");
    result.bands = size("bands");
    if (const auto e = take("header offset"))
      result.header_offset = integer<std::uint64_t>(*e, "header offset");
    result.data_type = type();
    result.interleave = interleave();
    if (const auto e = take("byte order")) {
      if (e->value != "0" && e->value != "1") fail(*e, "byte order", "0 (little endian) or 1 (big endian)");
      result.big_endian = e->value == "1";
    }
    result.description = text("description");
    result.wavelength_units = text("wavelength units");
    result.data_units = text("data units");
    result.coordinate_system = text("coordinate system string");
    result.map_info = split(text("map info"));
    result.band_names = list("band names", result.bands);
    const std::string file_type = lower(text("file type"));
    result.is_spectral_library = file_type == "envi spectral library";
    result.is_classification = file_type == "envi classification";
    const int channels = result.is_spectral_library ? result.samples : result.bands;
    result.wavelength = numbers("wavelength", channels);
    result.fwhm = numbers("fwhm", channels);
    if (const auto e = take("default bands"))
      for (const auto& item : split(e->value)) {
        const int band = integer<int>({item, e->line}, "default bands");
        if (band < 1 || band > result.bands)
          fail(*e, "default bands", format("numbers from 1 to {}", result.bands));
        result.default_bands.push_back(band);
      }
    check_volume(result);
    for (auto& [key, entry] : entries_) result.other.emplace(key, std::move(entry.value));
    return result;
  }

 private:
  void read_entries(std::string_view text) {
    int line = 0;
    bool first = true;
    while (!text.empty()) {
      const auto end = text.find('\n');
      std::string_view row = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line;
      if (first) {
        if (trimmed(row) != "ENVI")
          throw InputError(format("{}:1: not an ENVI header: the first line must be \"ENVI\"", file_),
                           {file_, 1, 1});
        first = false;
        continue;
      }
      if (trimmed(row).empty() || trimmed(row).front() == ';') continue;
      const auto equals = row.find('=');
      if (equals == std::string_view::npos)
        throw InputError(format("{}:{}: expected \"key = value\", found \"{}\"", file_, line, excerpt(row)),
                         {file_, line, 1});
      const std::string key = lower(trimmed(row.substr(0, equals)));
      Entry entry{std::string(trimmed(row.substr(equals + 1))), line};
      if (!entry.value.empty() && entry.value.front() == '{') {
        while (entry.value.find('}') == std::string::npos) {
          if (text.empty())
            throw InputError(
                format("{}:{}: \"{}\" opens a brace that is never closed", file_, entry.line, key),
                {file_, entry.line, 1});
          const auto next = text.find('\n');
          entry.value.append("\n").append(text.substr(0, next));
          text.remove_prefix(next == std::string_view::npos ? text.size() : next + 1);
          ++line;
        }
        entry.value = trimmed(std::string_view(entry.value).substr(1, entry.value.find('}') - 1));
      }
      entries_.insert_or_assign(key, std::move(entry));
    }
    if (first)
      throw InputError(format("{}: the file is empty; expected an ENVI header", file_), {file_, 1, 1});
  }

  static std::string excerpt(std::string_view value) {
    return value.size() > 60 ? std::string(value.substr(0, 60)) + "..." : std::string(trimmed(value));
  }

  [[noreturn]] void fail(const Entry& entry, std::string_view key, const std::string& expected) const {
    throw InputError(format("{}:{}: \"{}\" is \"{}\"; expected {}", file_, entry.line, key,
                            excerpt(entry.value), expected),
                     {file_, entry.line, 1});
  }

  std::optional<Entry> take(const std::string& key) {
    const auto found = entries_.find(key);
    if (found == entries_.end()) return std::nullopt;
    Entry entry = std::move(found->second);
    entries_.erase(found);
    return entry;
  }

  Entry need(const std::string& key) {
    auto entry = take(key);
    if (!entry) throw InputError(format("{}: the header has no \"{}\"", file_, key), {file_, 0, 0});
    return *entry;
  }

  std::string text(const std::string& key) {
    const auto entry = take(key);
    return entry ? entry->value : std::string();
  }

  template <class T>
  T integer(const Entry& entry, std::string_view key) const {
    T value{};
    const char* end = entry.value.data() + entry.value.size();
    const auto [stop, error] = std::from_chars(entry.value.data(), end, value);
    if (error != std::errc() || stop != end) fail(entry, key, "a whole number");
    return value;
  }

  int size(const std::string& key) {
    const Entry entry = need(key);
    const int value = integer<int>(entry, key);
    if (value < 1) fail(entry, key, "a whole number of at least 1");
    return value;
  }

  EnviType type() {
    const Entry entry = need("data type");
    const int number = integer<int>(entry, "data type");
    for (const int known : {1, 2, 3, 4, 5, 12, 13})
      if (number == known) return static_cast<EnviType>(number);
    fail(entry, "data type", "1, 2, 3, 4, 5, 12 or 13 (real numbers)");
  }

  EnviInterleave interleave() {
    const Entry entry = need("interleave");
    const std::string name = lower(entry.value);
    if (name == "bsq") return EnviInterleave::bsq;
    if (name == "bil") return EnviInterleave::bil;
    if (name == "bip") return EnviInterleave::bip;
    fail(entry, "interleave", "bsq, bil or bip");
  }

  std::vector<std::string> list(const std::string& key, int count) {
    const auto entry = take(key);
    if (!entry) return {};
    auto items = split(entry->value);
    if (static_cast<int>(items.size()) != count)
      fail({format("a list of {}", items.size()), entry->line}, key, format("{} items, one a band", count));
    return items;
  }

  std::vector<double> numbers(const std::string& key, int count) {
    const int line = entries_.contains(key) ? entries_.at(key).line : 0;
    std::vector<double> values;
    for (const auto& item : list(key, count)) {
      double value = 0.0;
      const auto [stop, error] = std::from_chars(item.data(), item.data() + item.size(), value);
      if (error != std::errc() || stop != item.data() + item.size()) fail({item, line}, key, "numbers");
      values.push_back(value);
    }
    return values;
  }

  void check_volume(const EnviHeader& h) const {
    const auto plane = static_cast<std::uint64_t>(h.samples) * static_cast<std::uint64_t>(h.lines);
    if (plane > kMostBytes / 8 / static_cast<std::uint64_t>(h.bands) || h.header_offset > kMostBytes)
      throw InputError(
          format("{}: {} x {} x {} values are more than any file holds", file_, h.samples, h.lines, h.bands),
          {file_, 0, 0});
  }

  std::string file_;
  std::map<std::string, Entry> entries_;
};

template <class T, class Write>
void append_list(std::string& out, std::string_view key, const std::vector<T>& values, const char* separator,
                 Write write) {
  if (values.empty()) return;
  out += format("{} = {{", key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += separator;
    out += write(values[i]);
  }
  out += "}\n";
}

}  // namespace

std::string list_item(std::string text) {
  for (char& c : text) {
    if (c == '{') c = '(';
    if (c == '}') c = ')';
    if (c == ',') c = ';';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

std::size_t bytes_per_value(EnviType type) {
  switch (type) {
    case EnviType::byte: return 1;
    case EnviType::int16:
    case EnviType::uint16: return 2;
    case EnviType::float64: return 8;
    case EnviType::int32:
    case EnviType::uint32:
    case EnviType::float32: break;
  }
  return 4;
}

std::uint64_t EnviHeader::data_bytes() const {
  return static_cast<std::uint64_t>(samples) * static_cast<std::uint64_t>(lines) *
         static_cast<std::uint64_t>(bands) * bytes_per_value(data_type);
}

std::string to_text(const EnviHeader& h) {
  std::string out = "ENVI\n";
  std::string description = h.description;
  std::replace(description.begin(), description.end(), '{', '(');
  std::replace(description.begin(), description.end(), '}', ')');
  if (!description.empty()) out += format("description = {{\n{}}}\n", description);
  out += format(
      "samples = {}\nlines = {}\nbands = {}\nheader offset = {}\nfile type = {}\ndata type = {}\n"
      "interleave = {}\nbyte order = {}\n",
      h.samples, h.lines, h.bands, h.header_offset,
      h.is_classification ? "ENVI Classification" : "ENVI Standard", static_cast<int>(h.data_type),
      name_of(h.interleave), h.big_endian ? 1 : 0);
  append_list(out, "map info", h.map_info, ", ", list_item);
  if (!h.coordinate_system.empty()) out += format("coordinate system string = {{{}}}\n", h.coordinate_system);
  append_list(out, "default bands", h.default_bands, ", ", [](int b) { return format("{}", b); });
  if (!h.data_units.empty()) out += format("data units = {}\n", list_item(h.data_units));
  append_list(out, "band names", h.band_names, ",\n", list_item);
  if (!h.wavelength_units.empty()) out += format("wavelength units = {}\n", h.wavelength_units);
  const auto number = [](double value) { return format("{:.10g}", value); };
  append_list(out, "wavelength", h.wavelength, ", ", number);
  append_list(out, "fwhm", h.fwhm, ", ", number);
  for (const auto& [key, value] : h.other)
    out += value.find_first_of(",\n") == std::string::npos ? format("{} = {}\n", key, value)
                                                           : format("{} = {{{}}}\n", key, value);
  return out;
}

EnviHeader parse_envi_header(std::string_view text, const std::string& file) {
  return Parser(text, file).header();
}

}  // namespace ifov::io
