#pragma once

#include <filesystem>
#include <vector>

#include "atmosphere/imported_path.h"
#include "io/atmosphere/uvspec_input.h"

namespace ifov::io {

/// Paths of an output of libRadtran's uvspec with the input file that made it: one for each altitude (zout),
/// umu and phi; the irradiances of an altitude stand in all of its paths. Solar output is taken for
/// mW m-2 nm-1 (sr-1), as with the solar spectra that libRadtran brings; thermal output for W m-2 (sr-1) per
/// nm or cm-1. Transmittances are divided by the cosine of the Sun's zenith angle, which uvspec does not do.
/// Throws InputError with the place where the output does not have the shape that the input asks for.
std::vector<atmosphere::ImportedPath> read_uvspec(const std::filesystem::path& output,
                                                  const std::filesystem::path& input);
std::vector<atmosphere::ImportedPath> parse_uvspec(const TextFile& output, const UvspecInput& input);

}  // namespace ifov::io
