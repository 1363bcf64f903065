#include "honesty/figure_row.h"

#include <cmath>

#include "core/format.h"

namespace ifov::benchmarks {

std::string json_number(double value) { return std::isfinite(value) ? format("{:.6g}", value) : "null"; }

std::string json(const std::vector<FigureRow>& rows) {
  std::string text;
  for (const FigureRow& row : rows)
    text +=
        format(R"({}"{}": {{"value": {}, "unit": "{}", "must": "{}", "ok": {}}})", text.empty() ? "" : ",\n ",
               row.name, row.value, row.unit, row.must, row.ok ? "true" : "false");
  return "{" + text + "}\n";
}

}  // namespace ifov::benchmarks
