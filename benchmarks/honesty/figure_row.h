#pragma once

#include <string>
#include <vector>

namespace ifov::benchmarks {

/// One figure of a benchmark: a JSON number (or null where there is none), its unit, and what it must be.
struct FigureRow {
  std::string name, value, unit, must;
  bool ok = false;
};

/// A number as JSON has it: null where it is not finite.
std::string json_number(double value);

/// One object with a member for each row, as benchmarks/drivers read it.
std::string json(const std::vector<FigureRow>& rows);

}  // namespace ifov::benchmarks
