#include "geodesy/orbit/sgp4_verification.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "core/format.h"

namespace ifov::geodesy {
namespace {

/// Made to have no position at all; the program that wrote the answers printed what it had of the satellite before.
constexpr int kFailsAtOnce = 33334;

struct GivenOrbit {
  std::string first, second;
  double stop_min = 0.0;
};
struct ToldState {
  double minutes = 0.0, position_km[3] = {}, velocity_km_s[3] = {};
};

std::vector<GivenOrbit> given_orbits(std::string_view text) {
  std::vector<GivenOrbit> found;
  std::istringstream stream{std::string(text)};
  for (std::string line, first; std::getline(stream, line);) {
    if (line.rfind("1 ", 0) == 0) first = line;
    if (line.rfind("2 ", 0) != 0 || line.size() < 70) continue;
    double start = 0.0, stop = 0.0;
    std::istringstream(line.substr(69)) >> start >> stop;
    found.push_back({with_checksum(first), with_checksum(line), stop});
  }
  return found;
}

std::vector<std::vector<ToldState>> told_states(std::string_view text) {
  std::vector<std::vector<ToldState>> found;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    if (line.find("xx") != std::string::npos) {
      found.emplace_back();
      continue;
    }
    ToldState state;
    std::istringstream words(line);
    words >> state.minutes;
    for (double& x : state.position_km) words >> x;
    for (double& v : state.velocity_km_s) words >> v;
    if (words && !found.empty()) found.back().push_back(state);
  }
  return found;
}

}  // namespace

std::string with_checksum(std::string line) {
  line.resize(69, ' ');
  int sum = 0;
  for (const char symbol : line.substr(0, 68))
    sum += symbol == '-' ? 1 : symbol >= '0' && symbol <= '9' ? symbol - '0' : 0;
  line[68] = static_cast<char>('0' + sum % 10);
  return line;
}

double Sgp4Verification::farthest_km() const {
  double most = 0.0;
  for (const Satellite& satellite : satellites) most = std::max(most, satellite.farthest_km);
  return most;
}

double Sgp4Verification::fastest_km_s() const {
  double most = 0.0;
  for (const Satellite& satellite : satellites) most = std::max(most, satellite.fastest_km_s);
  return most;
}

std::size_t Sgp4Verification::states() const {
  std::size_t sum = 0;
  for (const Satellite& satellite : satellites) sum += satellite.states;
  return sum;
}

bool Sgp4Verification::faults_as_made() const {
  return faults == std::map<int, OrbitFault>{{20413, OrbitFault::decayed},
                                             {22312, OrbitFault::eccentricity},
                                             {28350, OrbitFault::eccentricity},
                                             {28872, OrbitFault::decayed},
                                             {29141, OrbitFault::decayed},
                                             {33333, OrbitFault::semi_latus_rectum},
                                             {kFailsAtOnce, OrbitFault::perturbed_eccentricity}};
}

Sgp4Verification verify_sgp4(std::string_view elements, std::string_view answers) {
  const std::vector<GivenOrbit> given = given_orbits(elements);
  const std::vector<std::vector<ToldState>> told = told_states(answers);
  if (given.size() != told.size() || given.empty())
    throw InputError(format("elements of {} satellites and positions of {}; expected as many of both",
                            given.size(), told.size()));
  Sgp4Verification result;
  for (std::size_t k = 0; k < given.size(); ++k) {
    const Sgp4 orbit(parse_two_line_elements(given[k].first, given[k].second));
    const int number = orbit.elements().catalogue_number;
    Sgp4Verification::Satellite& satellite = result.satellites.emplace_back();
    satellite.catalogue_number = number;
    for (const ToldState& row : told[k]) {
      if (number == kFailsAtOnce) break;
      const OrbitState state = orbit.after_minutes(row.minutes);
      if (state.fault != OrbitFault::none)
        throw InputError(format("satellite {} has no position {} minutes after its epoch; one is told",
                                number, row.minutes));
      const math::Point3 p = state.position.p;
      const math::Vec3 v = state.velocity_m_s.v;
      const double at[3] = {p.x, p.y, p.z}, moving[3] = {v.x, v.y, v.z};
      for (int axis = 0; axis < 3; ++axis) {
        satellite.farthest_km =
            std::max(satellite.farthest_km, std::abs(at[axis] / 1000.0 - row.position_km[axis]));
        satellite.fastest_km_s =
            std::max(satellite.fastest_km_s, std::abs(moving[axis] / 1000.0 - row.velocity_km_s[axis]));
      }
      ++satellite.states;
    }
    // The answers end at a satellite's first fault.
    const double last = told[k].empty() ? 0.0 : told[k].back().minutes;
    for (double minutes = last; minutes <= given[k].stop_min; minutes += 1.0)
      if (const OrbitFault fault = orbit.after_minutes(minutes).fault; fault != OrbitFault::none) {
        result.faults[number] = fault;
        break;
      }
  }
  return result;
}

}  // namespace ifov::geodesy
