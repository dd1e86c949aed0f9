// Built for any x86-64, run before anything else of the program: the rest uses AVX2 and its kin
// from its first static initialiser on, and would end with "Illegal instruction" where they are
// not.
#include <unistd.h>

#include <cstring>

namespace {

__attribute__((constructor(101))) void CheckProcessor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v3")) return;
  constexpr const char* kComplaint =
      "aisle: this processor lacks AVX2, FMA, BMI2, F16C, LZCNT or MOVBE; one of x86-64-v3 (Intel "
      "since 2013, AMD since 2015) is needed\n";
  [[maybe_unused]] const ssize_t written =
      ::write(STDERR_FILENO, kComplaint, std::strlen(kComplaint));
  ::_exit(3);
}

}  // namespace
