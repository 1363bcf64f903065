// Prints what a figure of docs/ shows: figure_data NAME.
#include "figure_data.h"

#include <cstdio>
#include <string_view>
#include <utility>

int main(int count, char** words) {
  using namespace ifov::figures;
  constexpr std::pair<std::string_view, void (*)()> sets[] = {
      {"sampler", print_sampler_points},
      {"sequence", print_sequence},
      {"scatter", print_random_positions},
      {"bsdf", print_bsdf},
      {"footprint", print_footprint},
      {"nodes", print_nodes},
      {"fresnel", print_fresnel},
      {"sun", print_sun},
      {"gases", print_gases},
      {"phase", print_phase},
      {"round_earth", print_round_earth},
      {"adjacency", print_adjacency},
      {"model_error", print_model_error},
      {"photon_transfer", print_photon_transfer},
      {"temperatures", print_temperatures},
      {"orbit", print_orbit},
      {"image", print_image},
  };
  for (const auto& [name, print] : sets)
    if (count == 2 && name == words[1]) {
      print();
      return 0;
    }
  std::fputs("figure_data NAME, one of:", stderr);
  for (const auto& [name, print] : sets)
    std::fprintf(stderr, " %.*s", static_cast<int>(name.size()), name.data());
  std::fputs("\n", stderr);
  return 1;
}
