#pragma once

#include <cstddef>
#include <vector>

namespace ifov::render {

struct Polarimetry;

/// Q, U and V of a channel are judged as its radiance is: adds their columns (StokesColumns) to the channels' own, where they
/// are told. `polarimetry` may be null.
void add_stokes_columns(const Polarimetry* polarimetry, std::size_t channels, std::vector<int>& columns);

}  // namespace ifov::render
