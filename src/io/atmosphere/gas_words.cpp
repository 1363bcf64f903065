#include "io/atmosphere/gas_words.h"

#include <vector>

#include "core/format.h"
#include "core/names.h"
#include "io/tables/text_table.h"

namespace ifov::io {

std::optional<atmosphere::Gas> gas_of(std::string_view word) {
  for (std::size_t g = 0; g < atmosphere::kGasCount; ++g)
    if (lower_case(atmosphere::kGasNames[g]) == lower_case(word)) return static_cast<atmosphere::Gas>(g);
  return std::nullopt;
}

std::string unknown_gas(std::string_view word) {
  const std::vector<std::string> names(atmosphere::kGasNames.begin(), atmosphere::kGasNames.end());
  return format("unknown gas '{}'; expected {}{}", word, list_names(names), did_you_mean(word, names));
}

}  // namespace ifov::io
