#include "studies/studies.h"

#include "studies/aliasing_study.h"
#include "studies/atmosphere/atmosphere_study.h"
#include "studies/sensor/sensor_study.h"
#include "studies/suburb/suburb_study.h"
#include "studies/surfaces/surfaces_study.h"
#include "studies/temperature/temperature_study.h"
#include "studies/thermal_study.h"

namespace ifov::studies {

namespace {

constexpr StudyEntry kStudies[] = {
    {"aliasing", "a resolution chart by every sampler, against the exact answer", run_aliasing_study},
    {"thermal", "hot targets smaller than a pixel: samples needed for an accuracy", run_thermal_study},
    {"suburb", "sub-pixel content of a hyperspectral image, by every sampler", run_suburb_study, true},
    {"atmosphere", "the modelled atmosphere against tables and other programs", run_atmosphere_study},
    {"surfaces", "models of scattering against what they promise, by themselves and rendered",
     run_surfaces_study},
    {"sensor", "orbits, cameras, scanners, optics and detectors against closed forms and published figures",
     run_sensor_study},
    {"temperature", "temperatures solved under weather, against closed forms and full solutions of points",
     run_temperature_study},
};

}  // namespace

std::span<const StudyEntry> all_studies() { return kStudies; }

const StudyEntry* find_study(std::string_view name) {
  for (const StudyEntry& study : kStudies)
    if (study.name == name) return &study;
  return nullptr;
}

}  // namespace ifov::studies
