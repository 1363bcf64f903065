// Preloaded into a program, makes its clock of the day jump: by a day back and forth, at every look at it. Clocks that only
// count on are left alone.
#include <dlfcn.h>
#include <sys/time.h>

#include <atomic>
#include <ctime>

namespace {

std::atomic<int> looks{0};

long jump_s() {
  constexpr long kDay_s = 86400;
  return looks.fetch_add(1) % 2 == 0 ? kDay_s : -kDay_s;
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const auto real = original<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += jump_s();
  return result;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  static const auto real = original<int (*)(timeval*, void*)>("gettimeofday");
  const int result = real(now, zone);
  now->tv_sec += jump_s();
  return result;
}

time_t time(time_t* to) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (to != nullptr) *to = now.tv_sec;
  return now.tv_sec;
}
}
