#include "cli/interrupt.h"

#include <csignal>

namespace ifov::cli {
namespace {

CancelToken& token() {
  static CancelToken cancel;
  return cancel;
}

// Both calls are async-signal-safe; the token is made before the handler is installed.
extern "C" void on_interrupt(int signal) {
  token().cancel();
  std::signal(signal, SIG_DFL);
}

}  // namespace

CancelToken& cancel_on_interrupt() {
  CancelToken& cancel = token();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return cancel;
}

}  // namespace ifov::cli
