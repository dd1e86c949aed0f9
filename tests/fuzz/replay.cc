// In a fuzzer's place, where there is no clang: every file of a corpus, and mutants of each by a
// fixed seed. Usage: fuzz_TARGET [--mutants N] FOLDER
#include <algorithm>
#include <cstring>
#include <fstream>
#include <random>
#include <vector>

#include "tests/fuzz/fuzz.h"

namespace {

namespace fs = std::filesystem;

void Feed(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Bytes changed, words replaced, pieces lost or doubled, the end cut off: one to four of that.
std::string Mutant(std::string bytes, std::mt19937* random) {
  constexpr std::uint32_t kWords[] = {0,          1,          0xFF,       0xFFFF,
                                      0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000};
  const auto dice = [&](std::size_t below) { return (*random)() % below; };
  for (std::size_t edits = 1 + dice(4); edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = dice(bytes.size());
    switch (dice(6)) {
      case 0:
        bytes.erase(at, 1 + dice(16));
        break;
      case 1:
        bytes.insert(at, bytes.substr(dice(bytes.size()), 1 + dice(64)));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        std::memcpy(bytes.data() + at, &kWords[dice(8)],
                    std::min<std::size_t>(4, bytes.size() - at));
        break;
      default:
        bytes[at] = static_cast<char>((*random)());
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  int mutants = 100;
  fs::path folder;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--mutants") == 0 && i + 1 < argc) {
      mutants = std::atoi(argv[++i]);
    } else {
      folder = argv[i];
    }
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    std::cerr << folder << ": holds nothing\n";
    return 1;
  }
  std::vector<std::string> seeds;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    Feed(seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()));
  }
  if (aisle::fuzz::taken == 0) {
    std::cerr << folder << ": nothing of it is taken; is it of an older format?\n";
    return 1;
  }
  auto inputs = std::ssize(seeds);
  std::mt19937 random(1);
  for (const std::string& seed : seeds) {
    for (int i = 0; i < mutants; ++i, ++inputs) Feed(Mutant(seed, &random));
  }
  std::cout << inputs << " inputs, nothing found\n";
}
