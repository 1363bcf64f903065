#include "sampling/accuracy/borders/traced_pixels.h"

namespace ifov::sampling {

void TracedPixels::abandon_beyond_budget(std::span<const std::uint32_t> rays) {
  bool any = false;
  for (std::size_t p = 0; p < rays.size(); ++p) any |= rays[p] > budget_[p];  // many at a time
  if (!any) return;
  for (std::size_t p = 0; p < rays.size(); ++p)
    if (rays[p] > budget_[p]) {
      abandon(static_cast<std::uint32_t>(p));
      budget_[p] = ~std::uint32_t{0};  // once is enough
    }
}

void TracedPixels::take_stirred(std::vector<std::uint8_t>& stirred) {
  if (allowed_may_differ_) {
    for (std::size_t p = 0; p < allowed_variance_.size(); ++p)
      if (allowed_variance_[p] != sharpened_for_[p]) stirred_[p] = 1;
    sharpened_for_ = allowed_variance_;
    allowed_may_differ_ = false;
  }
  stirred.resize(stirred_.size());
  stirred.swap(stirred_);
  std::fill(stirred_.begin(), stirred_.end(), std::uint8_t{0});
}

}  // namespace ifov::sampling
