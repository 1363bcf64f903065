#pragma once

#include <string>

#include "ifov/version.h"

namespace ifov {

/// Tells builds of one version apart: the linker's build id, shortened, and the C library's version.
std::string build_id();

/// The level of the x86-64 instruction set that the machine has: "x86-64-v3". Mathematical functions of libraries
/// choose by it.
std::string instruction_set();

}  // namespace ifov
