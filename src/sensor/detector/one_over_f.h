#pragma once

#include <cstdint>
#include <vector>

namespace ifov::sensor {

struct Detector;

/// One realisation of the 1/f part of the read noise of one channel's image, electrons, line after line: every column is read by an
/// amplifier of its own, one value a line, whose noise has the two-sided spectrum read_noise^2 corner / |f| (6), f in cycles a line.
/// It is drawn as Fourier series (Timmer and Koenig 1995: On generating power law noise, Astronomy and Astrophysics 300, 707-710) of twice
/// as many lines or more, of which the first are taken; slower changes are none. Empty where the noise is white.
std::vector<float> one_over_f_noise(const Detector& detector, std::uint64_t seed, int channel, int lines,
                                    int columns, int threads);

}  // namespace ifov::sensor
