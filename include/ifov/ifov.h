#pragma once

/// The whole of libifov: documents in, calibrated radiance with error bars out. Everything is in namespace ifov.
///
///   const ifov::Document document = ifov::Document::read("scene.json", {"sensor.camera.orthographic.gsd=2 m"});
///   const ifov::Simulation simulation = ifov::Simulation::load(document);
///   const ifov::Outcome outcome = simulation.render({.folder = "out"});
///
/// docs/guide/library.md shows a whole program. Units are SI, wavelengths in micrometres, spectral radiance in
/// W m-2 sr-1 um-1.

#include "ifov/assets.h"
#include "ifov/atmosphere.h"
#include "ifov/brdf.h"
#include "ifov/check.h"
#include "ifov/detect.h"
#include "ifov/document.h"
#include "ifov/error.h"
#include "ifov/gas_model.h"
#include "ifov/instruments.h"
#include "ifov/materials.h"
#include "ifov/outcome.h"
#include "ifov/products.h"
#include "ifov/radiometry.h"
#include "ifov/run_control.h"
#include "ifov/runs.h"
#include "ifov/sampling.h"
#include "ifov/sensor.h"
#include "ifov/series.h"
#include "ifov/simulation.h"
#include "ifov/temperature.h"
#include "ifov/tile.h"
#include "ifov/version.h"
