#include "atmosphere/particles/aerosol_tables.h"

#include <algorithm>
#include <string_view>

#include "atmosphere/tables/table_text.h"

namespace ifov::data {
extern const std::string_view atmosphere_aerosols;
}

namespace ifov::atmosphere {

double AerosolTables::Height::at(double altitude) const {
  const auto found = std::find(altitude_km.begin(), altitude_km.end(), altitude);
  return found == altitude_km.end() ? 0.0
                                    : extinction_km[static_cast<std::size_t>(found - altitude_km.begin())];
}

const AerosolTables& AerosolTables::instance() {
  static const AerosolTables all = [] {
    AerosolTables tables;
    for (const TableSection& section : parse_table_text(data::atmosphere_aerosols)) {
      const auto column = [&](std::size_t first, std::size_t stride) {
        return table_column(section, first, stride);
      };
      if (section.words[0] == "optics")
        tables.optics[section.words[1]].push_back(
            {std::stod(section.words[2]), column(0, 4), column(1, 4), column(2, 4), column(3, 4)});
      else
        tables.heights[section.words[1]] = {column(0, 2), column(1, 2)};
    }
    return tables;
  }();
  return all;
}

}  // namespace ifov::atmosphere
