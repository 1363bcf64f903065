#pragma once

namespace ifov::render {

struct Polarimetry;

/// What is told of the light of a sample beside its radiance.
struct LightTold {
  const Polarimetry* polarimetry = nullptr;  ///< null: nothing of its polarization
  bool parts = false;                        ///< the parts that it is made of (transport::LightPart)

  LightTold(const Polarimetry* of_polarization = nullptr, bool with_parts = false)
      : polarimetry(of_polarization), parts(with_parts) {}
};

}  // namespace ifov::render
