#pragma once

#include <cstdint>

namespace ifov::sampling {

class LabelTable;
class Lattice;
class RayLedger;
struct LatticeValues;

/// Labels and values at the lattice's vertices; values in the order in which they are asked for.
void ask_vertices(const Lattice& lattice, RayLedger& ledger, std::uint64_t seed, LatticeValues& at);

/// Labels of one material whose values at all vertices are the same to the last bit (black things at one
/// temperature, level ground under the Sun) are one label: no radiance tells them apart, and a border between
/// them would cost rays for nothing.
void merge_twins(RayLedger& ledger, LabelTable& table, LatticeValues& at);

/// Means of the labels, and which pixels show one label alone.
void take_means(const Lattice& lattice, LabelTable& table, LatticeValues& at);

}  // namespace ifov::sampling
