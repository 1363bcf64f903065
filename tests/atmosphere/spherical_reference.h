#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "atmosphere/column_maker.h"

namespace ifov::atmosphere::test {

/// A row of tests/atmosphere/spherical_reference.csv, which says what it is.
struct Row {
  std::string what;  ///< sky, above or flux
  bool haze = false;
  double depth, sun, zenith, azimuth, all, error, once;
};
inline std::vector<Row> reference() {
  std::ifstream file(IFOV_SOURCE_DIR "/tests/atmosphere/spherical_reference.csv");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#' || line.rfind("what", 0) == 0) continue;
    for (char& c : line)
      if (c == ',') c = ' ';
    std::istringstream words(line);
    Row row;
    words >> row.what >> row.depth >> row.sun >> row.zenith >> row.azimuth >> row.all >> row.error >>
        row.once;
    EXPECT_TRUE(words) << line;
    constexpr std::string_view kHaze = "_haze";
    if ((row.haze = row.what.ends_with(kHaze))) row.what.resize(row.what.size() - kHaze.size());
    rows.push_back(row);
  }
  return rows;
}

inline Column molecules(double depth) {
  Air air;
  air.rayleigh = depth;
  air.aerosol = air.aerosol_absorption = 0.0;
  Column column = air.column();
  column.optics.depolarization = 0.0;
  return column;
}

inline ColumnSolution solved(const Column& column, double sun_deg, bool spherical = true) {
  ScatteringOptions options;
  options.polarized = false;
  options.spherical_earth = spherical;
  return ColumnSolver(options).solve(column.levels, column.optics, sun_deg * kDegree);
}
inline ColumnSolution solve_molecules(double depth, double sun_deg, bool spherical = true) {
  return solved(molecules(depth), sun_deg, spherical);
}

/// The column of a row.
inline Column column_of(const Row& row) {
  if (!row.haze) return molecules(row.depth);
  Air air;
  air.rayleigh = row.depth;
  air.aerosol_absorption = 0.0;
  Column column = air.column();
  column.optics.depolarization = 0.0;
  return column;
}

}  // namespace ifov::atmosphere::test
