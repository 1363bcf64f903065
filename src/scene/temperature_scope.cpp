#include "scene/temperature_scope.h"

namespace ifov::scene {
namespace {
thread_local TemperatureScope* current_scope = nullptr;
}  // namespace

TemperatureScope::TemperatureScope() : outer_(current_scope) { current_scope = this; }
TemperatureScope::~TemperatureScope() { current_scope = outer_; }
TemperatureScope* TemperatureScope::current() { return current_scope; }

}  // namespace ifov::scene
