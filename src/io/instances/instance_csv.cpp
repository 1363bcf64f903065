#include "io/instances/instance_csv.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "core/error.h"
#include "io/files/inputs.h"
#include "io/files/mapped_file.h"
#include "io/tables/text_table.h"
#include "math/angle.h"

namespace ifov::io {
namespace {

constexpr std::size_t kMostFields = 7;
constexpr std::string_view kColumns[kMostFields] = {"x", "y", "z", "yaw", "scale", "pitch", "roll"};

class RowReader {
 public:
  RowReader(std::string name, std::string_view text) : name_(std::move(name)), text_(text) {}

  std::vector<Instance> read() {
    std::vector<Instance> found;
    bool heading_allowed = true;
    std::string_view rest = text_;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty()) {
      const std::size_t end = rest.find_first_of("\r\n");
      line_ = rest.substr(0, end);
      ++number_;
      rest.remove_prefix(
          end == std::string_view::npos ? rest.size() : end + 1 + std::size_t(rest.substr(end, 2) == "\r\n"));
      if (is_blank(line_) || is_comment(line_)) continue;
      if (heading_allowed && !number_in(split(line_, separator_of(line_))[0].text)) {
        heading_allowed = false;
        check_heading();
        continue;
      }
      heading_allowed = false;
      found.push_back(row());
    }
    return found;
  }

 private:
  [[noreturn]] void fail(int column, const std::string& message) const {
    throw table_error(name_, number_, column, line_, message);
  }

  /// A heading may say anything, but a column that it names must be the one that is read so.
  void check_heading() const {
    const std::vector<Field> fields = split(line_, separator_of(line_));
    for (std::size_t k = 0; k < fields.size(); ++k) {
      const auto column = std::find(std::begin(kColumns), std::end(kColumns), lower_case(fields[k].text)) -
                          std::begin(kColumns);
      if (column < std::ssize(kColumns) && static_cast<std::size_t>(column) != k)
        fail(
            fields[k].column,
            format(
                "found '{}' as column {}; expected the columns x, y, z, yaw, scale, pitch, roll in this order",
                fields[k].text, k + 1));
    }
  }

  Instance row() {
    const std::vector<Field> fields = split(line_, separator_of(line_));
    if (columns_ == 0) {
      columns_ = fields.size();
      if (columns_ < 3 || columns_ > kMostFields || columns_ == 6)
        fail(0, format("found {} fields; expected 3, 4, 5 or 7 numbers: x, y, z, yaw, scale, pitch, roll",
                       columns_));
    } else if (fields.size() != columns_) {
      fail(0, format("found {} fields; expected {} numbers, as above", fields.size(), columns_));
    }
    double v[kMostFields] = {0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
    for (std::size_t k = 0; k < columns_; ++k) {
      const std::optional<double> value = number_in(fields[k].text);
      if (!value) fail(fields[k].column, format("found '{}'; expected a number", fields[k].text));
      v[k] = *value;
    }
    if (!(v[4] > 0.0)) fail(fields[4].column, format("the scale is {}; expected a number above 0", v[4]));
    return {{v[0], v[1], v[2]},
            quaternion_of(v[3] * math::kDegree, v[5] * math::kDegree, v[6] * math::kDegree),
            {v[4], v[4], v[4]}};
  }

  std::string name_;
  std::string_view text_, line_;
  int number_ = 0;
  std::size_t columns_ = 0;
};

}  // namespace

std::vector<Instance> read_instance_csv(const std::filesystem::path& path) {
  if (const auto* const asset = arrays_of_asset<std::vector<Instance>>(path, "a list of copies"))
    return *asset;
  const MappedFile file(path);
  const std::span<const std::byte> bytes = file.bytes();
  return RowReader(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}).read();
}

}  // namespace ifov::io
