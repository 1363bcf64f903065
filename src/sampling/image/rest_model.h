#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace ifov::sampling {

/// What a pixel's second level comes to by what the pixel shows: a regression on its shares of materials and on its first level, column
/// by column, from pixels of a survey. Other random numbers than the image's went into it.
class RestModel {
 public:
  struct Pixel {
    std::map<std::uint32_t, double> shares;  ///< of materials
    std::span<const double> direct, rest;    ///< by column
  };
  RestModel() = default;
  /// `leaders`: Field::leader() by column; a column that follows regresses on the first level of its leader, as that does.
  explicit RestModel(std::span<const Pixel> pixels, std::span<const std::size_t> leaders = {});

  /// Of a pixel: `direct` and `rest` by column, as many as the survey had. A material that the survey did not meet counts as all of
  /// them together.
  template <class Value>
  void predict(const std::map<std::uint32_t, double>& shares, const Value* direct, Value* rest) const {
    std::vector<double> sum(mean_rest_);
    for (const auto& [material, share] : shares)
      if (const auto found = materials_.find(material); found != materials_.end()) {
        const double* of = &of_share_[found->second * sum.size()];
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += share * of[c];
      }
    for (std::size_t c = 0; c < sum.size(); ++c)
      rest[c] = static_cast<Value>(
          sum[c] + of_direct_[c] * (static_cast<double>(direct[leaders_[c]]) - mean_direct_[leaders_[c]]));
  }

 private:
  std::map<std::uint32_t, std::size_t> materials_;
  std::vector<std::size_t> leaders_;                         // by column
  std::vector<double> mean_direct_, mean_rest_, of_direct_;  // by column
  std::vector<double> of_share_;                             // by material and column
};

}  // namespace ifov::sampling
