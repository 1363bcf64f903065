#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace ifov::test {

/// A row of LOWTRAN7's transmittance output.
struct LowtranRow {
  double wavenumber_cm1;
  double total, h2o, mixed, ozone, trace, n2_continuum, h2o_continuum, rayleigh, aerosol, hno3,
      aerosol_absorbed;
};

/// The numbers of every line that has at least `columns` of them and starts with a wavenumber of 350 cm-1 or
/// more.
inline std::vector<std::vector<double>> numeric_rows(const std::filesystem::path& file, std::size_t columns) {
  std::ifstream stream(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::vector<double> row;
    for (double value; words >> value;) row.push_back(value);
    if (words.eof() && row.size() >= columns && row[0] >= 350.0) rows.push_back(row);
  }
  return rows;
}

/// The numbers at the head of each line of a MODTRAN channel file (.chn), 26 of them.
inline std::vector<std::vector<double>> channel_rows(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::vector<double> row;
    for (double value; words >> value;) row.push_back(value);
    if (row.size() >= 26) rows.push_back(row);
  }
  return rows;
}

inline std::vector<LowtranRow> lowtran_rows(const std::filesystem::path& file) {
  std::vector<LowtranRow> rows;
  for (const std::vector<double>& v : numeric_rows(file, 13))
    rows.push_back({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8], v[9], v[10], v[11]});
  return rows;
}

}  // namespace ifov::test
