// Mutants of one format through the door, each in a reader of its own; mutants.py starts this.
//
//   door_mutants FORMAT FIRST COUNT MODELS_FOLDER
//
// FORMAT is glb, gltf, obj or dae; a mutant's number is its seed. MODELS_FOLDER holds the models of
// tests/support/gltf_models.py, and takes the mutants. Prints what became of them as one line of
// JSON. Ends with 0 whatever the door says, since to say it is what the door is for.
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <random>

#include "simulator/mesh/door/read_model.h"
#include "tests/simulator/mesh/mutants.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr ReadingLimits kLimits{.memory_bytes = std::size_t{1} << 30, .time_s = 20};

struct Outcomes {
  int taken = 0, refused = 0, died = 0, late = 0, large = 0, no_memory = 0;
  double slowest_s = 0;
  std::vector<std::string> wrong;  ///< what the door should not have let happen
};

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string MutantOf(const std::string& format, const fs::path& models, unsigned seed) {
  std::mt19937 random(seed);
  if (format == "glb") {
    constexpr std::array kWhole = {"same_names", "splines", "sparse", "quantized", "primitives"};
    return MutatedGlb(TextOf(models / (std::string(kWhole[seed % kWhole.size()]) + ".glb")),
                      &random);
  }
  if (format == "gltf") {
    return MutatedText(TextOf(models / (seed % 2 ? "text_inline.gltf" : "text_beside.gltf")),
                       &random);
  }
  return MutatedText(format == "obj" ? kObj : kCollada, &random);
}

/// One error of one line that names the file; else what is wrong with it.
std::string WrongWith(const std::string& what, const fs::path& file) {
  if (!what.starts_with(file.string() + ": ")) return "does not begin with the file: " + what;
  if (what.find('\n') != std::string::npos) return "has more than a line: " + what;
  if (what.size() < file.string().size() + 10) return "says nothing: " + what;
  return "";
}

void Count(const std::string& what, Outcomes* outcomes) {
  const auto says = [&](const char* part) { return what.find(part) != std::string::npos; };
  ++(says("did not survive")     ? outcomes->died
     : says("is not read after") ? outcomes->late
     : says("holds more than")   ? outcomes->large
     : says("memory")            ? outcomes->no_memory
                                 : outcomes->refused);
}

void Try(const fs::path& file, unsigned seed, Outcomes* outcomes) {
  const auto start = std::chrono::steady_clock::now();
  ModelDoor door;
  door.limits = kLimits;
  try {
    ReadModel(file, {}, door);
    ++outcomes->taken;
  } catch (const ImportError& error) {
    const std::string wrong = WrongWith(error.what(), file);
    if (!wrong.empty()) outcomes->wrong.push_back(fmt::format("{}: {}", seed, wrong));
    Count(error.what(), outcomes);
  } catch (const std::exception& error) {
    outcomes->wrong.push_back(fmt::format("{}: no error of the file: {}", seed, error.what()));
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  outcomes->slowest_s = std::max(outcomes->slowest_s, took.count());
  if (::waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD) {
    outcomes->wrong.push_back(fmt::format("{}: a process is left", seed));
  }
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const bool plain = c >= 0x20 && c != '"' && c != '\\' && c != 0x7F;
    quoted += plain ? std::string(1, c) : fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
  }
  return quoted + "\"";
}

void Print(const Outcomes& outcomes) {
  rusage readers{};
  ::getrusage(RUSAGE_CHILDREN, &readers);
  std::string wrong;
  for (const std::string& one : outcomes.wrong) wrong += (wrong.empty() ? "" : ", ") + Quoted(one);
  fmt::print(
      "{{\"taken\": {}, \"refused\": {}, \"died\": {}, \"late\": {}, \"large\": {}, "
      "\"no_memory\": {}, \"slowest_s\": {:.3f}, \"peak_mib\": {}, \"wrong\": [{}]}}\n",
      outcomes.taken, outcomes.refused, outcomes.died, outcomes.late, outcomes.large,
      outcomes.no_memory, outcomes.slowest_s, readers.ru_maxrss / 1024, wrong);
}

int Run(const std::string& format, unsigned first, unsigned count, const fs::path& models) {
  Outcomes outcomes;
  std::ofstream(models / "m.mtl") << kMtl;
  const fs::path file = models / ("mutant." + format);
  for (unsigned seed = first; seed < first + count; ++seed) {
    std::ofstream(file, std::ios::binary) << MutantOf(format, models, seed);
    Try(file, seed, &outcomes);
  }
  Print(outcomes);
  return 0;
}

}  // namespace
}  // namespace aisle::sim

int main(int argc, char** argv) {
  if (argc != 5) return 4;
  return aisle::sim::Run(argv[1], static_cast<unsigned>(std::stoul(argv[2])),
                         static_cast<unsigned>(std::stoul(argv[3])), argv[4]);
}
