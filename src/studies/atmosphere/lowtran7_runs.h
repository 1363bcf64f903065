#pragma once

#include "atmosphere/column/atmosphere_column.h"
#include "studies/atmosphere/atmosphere_results.h"

namespace ifov::studies {

/// A model atmosphere with the gases and the continuum of the program's time.
atmosphere::AtmosphereDescription as_in_1986(const std::string& model);

/// Thermal radiances and sunlight of the program's runs, against ours.
void add_lowtran7_radiances(const SectionOptions& options, AtmosphereSection& section);

}  // namespace ifov::studies
