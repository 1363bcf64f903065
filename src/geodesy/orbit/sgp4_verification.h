#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geodesy/orbit/sgp4.h"

namespace ifov::geodesy {

/// A line of two-line elements with the checksum that belongs to it: some of the verification's were made of others by hand.
std::string with_checksum(std::string line);

/// How far Sgp4 is from the positions that Vallado, Crawford, Hujsak and Kelso (2006) verify implementations with.
struct Sgp4Verification {
  struct Satellite {
    int catalogue_number = 0;
    double farthest_km = 0.0, fastest_km_s = 0.0;  ///< largest difference along an axis
    std::size_t states = 0;                        ///< that were compared
  };
  std::vector<Satellite> satellites;  ///< in the order of the elements
  std::map<int, OrbitFault> faults;   ///< the first one after the last position, by catalogue number

  double farthest_km() const;
  double fastest_km_s() const;
  std::size_t states() const;
  /// Whether these are the faults that the sets were made to have, and no others.
  bool faults_as_made() const;
};

/// `elements`: text of their SGP4-VER.TLE, with start, stop and step beyond column 69; `answers`: of their tcppver.out. InputError where
/// the two do not hold the same number of satellites, or no position is found where one is told.
Sgp4Verification verify_sgp4(std::string_view elements, std::string_view answers);

}  // namespace ifov::geodesy
