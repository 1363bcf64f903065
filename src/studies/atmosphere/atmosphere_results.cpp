#include "studies/atmosphere/atmosphere_results.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/files/input_file.h"

namespace ifov::studies {

std::vector<std::vector<double>> number_rows(const std::filesystem::path& file, std::size_t least_columns) {
  std::vector<std::vector<double>> rows;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return rows;
  std::istringstream stream(io::read_input(file));
  for (std::string line; std::getline(stream, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double> row;
    for (double value; words >> value;) row.push_back(value);
    if (row.size() >= least_columns) rows.push_back(std::move(row));
  }
  return rows;
}

void Differences::add(double value, double reference) {
  const double difference = value - reference;
  sum_ += difference;
  squares_ += difference * difference;
  largest_ = std::max(largest_, std::abs(difference));
  ++count_;
}

double Differences::rms() const { return count_ > 0 ? std::sqrt(squares_ / count_) : 0.0; }

}  // namespace ifov::studies
