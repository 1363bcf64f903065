#pragma once

#include <cstdint>
#include <string>

namespace ifov {

/// The most memory that this process has held so far (its peak resident set); 0 where the system does not
/// say.
std::uint64_t peak_memory_bytes();

/// The memory that this process holds now (its resident set); 0 where the system does not say.
std::uint64_t resident_memory_bytes();

/// What this process may hold: what the machine has available beside what the process holds already, and no
/// more than its limits (RLIMIT_AS, which counts what is mapped and not held too; the control group's memory.max) allow.
std::uint64_t memory_within_reach_bytes();

/// What to say where memory ran out: "memory ran out: 388.1 MB were held at most, and no more than 419.4 MB may be
/// mapped (ulimit -v); ...".
std::string memory_ran_out();

}  // namespace ifov
