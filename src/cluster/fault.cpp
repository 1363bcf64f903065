#include "cluster/fault.h"

#include <new>
#include <system_error>

#include "core/error.h"
#include "core/machine_memory.h"
#include "core/run_control.h"

namespace ifov::cluster {

Fault current_fault() {
  using Kind = Fault::Kind;
  try {
    throw;
  } catch (const Cancelled& error) {
    return {Kind::stopped, error.what()};
  } catch (const InputError& error) {
    return {Kind::input, error.what()};
  } catch (const SystemError& error) {
    return {Kind::environment, error.what()};
  } catch (const std::system_error& error) {
    return {Kind::environment, error.what()};
  } catch (const std::bad_alloc&) {
    return {Kind::environment, memory_ran_out()};
  } catch (const std::exception& error) {
    return {Kind::bug, error.what()};
  }
}

void raise(const Fault& fault, const std::string& rank) {
  const std::string text = format("{}: {}", rank, fault.text);
  switch (fault.kind) {
    case Fault::Kind::stopped: throw Cancelled();
    case Fault::Kind::input: throw InputError(text);
    case Fault::Kind::environment: throw SystemError(text);
    case Fault::Kind::none:
    case Fault::Kind::bug: break;
  }
  throw std::runtime_error(text);
}

void put(Payload& payload, const Fault& fault) {
  payload.put(fault.kind);
  payload.put(fault.text);
}

Fault take_fault(Payload& payload) {
  Fault fault;
  fault.kind = payload.take<Fault::Kind>();
  fault.text = payload.take<std::string>();
  return fault;
}

}  // namespace ifov::cluster
