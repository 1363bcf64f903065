#include "atmosphere/gas/fit_paths.h"

namespace ifov::atmosphere {

FitPaths::FitPaths(std::string_view model, const TermGas& gas, const StateGrid& states) {
  const std::vector<double> altitude_km{0.0,  0.25, 0.5,  0.75, 1.0,  1.5,  2.0,  2.5,  3.0,  3.5,
                                        4.0,  4.5,  5.0,  6.0,  7.0,  8.0,  9.0,  10.0, 11.0, 12.0,
                                        13.0, 14.0, 15.0, 16.0, 18.0, 20.0, 22.0, 24.0, 26.0, 28.0,
                                        30.0, 32.5, 35.0, 40.0, 45.0, 50.0, 60.0, 70.0, 100.0};
  const std::vector<LayerGas> layers = layer_gas(model_atmosphere(model), gas, altitude_km);
  for (std::size_t l = 0; l < layers.size(); ++l) {
    Layer layer{layers[l].molecules_cm2, states.place(layers[l].pressure_hPa, layers[l].temperature_K), {}};
    for (std::size_t k = 0; k < kSections.size(); ++k)
      layer.in[k] = altitude_km[l] >= kSections[k].from_km && altitude_km[l + 1] <= kSections[k].to_km;
    molecules_cm2_ += layer.molecules_cm2;
    layers_.push_back(layer);
  }
}

}  // namespace ifov::atmosphere
