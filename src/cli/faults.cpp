#include "cli/faults.h"

#include <signal.h>
#include <unistd.h>

#include <cstring>

#include "cli/exit_code.h"
#include "ifov/products.h"

namespace ifov::cli {
namespace {

void put(const char* text) {
  const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

/// Calls nothing that is not safe in a signal handler.
void on_bus_error(int signal, siginfo_t* info, void*) {
  const char* const name = mapped_input_at(info->si_addr);
  if (name == nullptr) {
    ::signal(signal, SIG_DFL);  // not a file of ours: the instruction is run again and ends the program
    return;
  }
  put("\nifov: '");
  put(name);
  put("' was cut short, or its disk failed, while it was being read\n");
  _exit(static_cast<int>(ExitCode::environment));
}

}  // namespace

void answer_faults() {
  struct sigaction on_bus {};
  on_bus.sa_sigaction = on_bus_error;
  on_bus.sa_flags = SA_SIGINFO;
  sigaction(SIGBUS, &on_bus, nullptr);
  signal(SIGXFSZ, SIG_IGN);
}

}  // namespace ifov::cli
