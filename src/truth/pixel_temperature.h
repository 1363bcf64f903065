#pragma once

#include "truth/collector.h"

namespace ifov::truth {

/// How warm the surfaces in a pixel's square are that its rays meet first, K: mean by area of the square, standard deviation over it,
/// lowest, highest, half-width of the mean at 95 %; and the share of the square where there is one with a temperature. Of 64 rays,
/// one in each cell of the square at a random place: the half-width is that of as many places drawn without cells, which is wider.
/// Not numbers where no ray meets a temperature.
extern const Collector kPixelTemperature;

}  // namespace ifov::truth
