#include "io/product_parts/turned_lines.h"

#include <algorithm>
#include <utility>

#include "io/product_parts/turned_bands.h"

namespace ifov::io {

TurnedLines::TurnedLines(int samples, int bands, std::size_t value_bytes, ReadAt read_at, std::size_t bytes,
                         std::size_t least_lines)
    : samples_(static_cast<std::size_t>(samples)),
      bands_(static_cast<std::size_t>(bands)),
      value_bytes_(value_bytes),
      read_at_(std::move(read_at)),
      most_lines_(std::max(least_lines, bytes / std::max<std::size_t>(samples_ * bands_ * value_bytes, 1))) {}

TurnedLines::Line TurnedLines::line(int line) const {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = kept_.find(line); found != kept_.end()) {
      found->second.looked_at = ++looks_;
      return found->second.line;
    }
  }
  const std::size_t bytes = samples_ * bands_ * value_bytes_;
  std::vector<std::byte> by_pixel(bytes);
  read_at_(static_cast<std::uint64_t>(line) * bytes, by_pixel.data(), bytes);
  auto turned = std::make_shared<std::vector<std::byte>>(bytes);
  turn_bands(by_pixel.data(), samples_, bands_, turned->data(), samples_, value_bytes_);
  const std::scoped_lock lock(mutex_);
  if (kept_.size() >= most_lines_ && !kept_.contains(line))
    kept_.erase(std::min_element(kept_.begin(), kept_.end(), [](const auto& a, const auto& b) {
      return a.second.looked_at < b.second.looked_at;
    }));
  kept_[line] = {turned, ++looks_};
  return turned;
}

}  // namespace ifov::io
