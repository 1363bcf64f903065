#pragma once

#include <array>
#include <cstddef>

namespace ifov::radiometry {
struct PolarizationFrame;
}

namespace ifov::transport {

/// Spectra of I, Q, U and V, in spectral nodes.
struct StokesRows {
  std::array<float*, 4> row{};

  float* operator[](std::size_t component) const { return row[component]; }
};

/// Q' = cosine Q + sine U, U' = -sine Q + cosine U: twice the angle between the axes of two frames of one direction.
struct FrameTurn {
  float cosine = 1.0f, sine = 0.0f;

  FrameTurn() = default;
  FrameTurn(const radiometry::PolarizationFrame& from, const radiometry::PolarizationFrame& to);
  /// In place, over n values.
  void apply(const StokesRows& light, std::size_t n) const {
    float* __restrict q = light[1];
    float* __restrict u = light[2];
    for (std::size_t i = 0; i < n; ++i) {
      const float before = q[i];
      q[i] = cosine * before + sine * u[i];
      u[i] = cosine * u[i] - sine * before;
    }
  }
};

}  // namespace ifov::transport
