#include "harness/io/keep.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdio>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

void SayOnce(const char* what) {
  static std::atomic_flag said;
  if (said.test_and_set()) return;
  fmt::print(stderr, "aisle: {}; continuing without the cache, which costs time only\n", what);
}

}  // namespace

void KeepWherePossible(const std::function<void()>& write) {
  try {
    write();
  } catch (const MachineError& error) {
    SayOnce(error.what());
  } catch (const InputError& error) {  // a file stands where the cache should be
    SayOnce(error.what());
  }
}

}  // namespace aisle
