#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

/// What a fuzzer calls with any bytes at all: LLVM's name. A target hands them to one reader. The
/// reader may throw the errors that its header names; whatever else leaves it (another exception, a
/// signal, a sanitizer's finding) ends the process and is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace aisle::fuzz {

inline std::string_view Text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// The bytes as a file in memory, for readers that take a path. One a name and process.
inline std::filesystem::path AsFile(std::string_view bytes, const std::string& name) {
  static const std::filesystem::path folder = [] {
    const std::filesystem::path made = "/dev/shm/aisle-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directories(made);
    std::atexit([] {
      std::error_code gone;
      std::filesystem::remove_all("/dev/shm/aisle-fuzz-" + std::to_string(::getpid()), gone);
    });
    return made;
  }();
  std::ofstream(folder / name, std::ios::binary).write(bytes.data(), std::ssize(bytes));
  return folder / name;
}

/// Ends the process where something does not hold that should.
inline void Hold(bool condition, const char* what) {
  if (condition) return;
  std::cerr << "does not hold: " << what << "\n";
  std::abort();
}

/// How many inputs the reader took. Where it takes nothing of a corpus, that is of a format that is
/// no more, and mutants of it try nothing.
inline long taken = 0;

}  // namespace aisle::fuzz
