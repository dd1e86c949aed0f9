#include "harness/cli/doctor_bits.h"

#include <cpuid.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "harness/cli/command.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/stage_bits.h"
#include "harness/record/provenance.h"
#include "harness/record/record_json.h"

namespace aisle {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kScene = "smoke/bits";

/// Maker and name as the processor itself says them: an emulator leaves /proc/cpuinfo as the
/// host's.
std::string ProcessorName() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  std::string name;
  const auto add = [&name](std::initializer_list<unsigned> words) {
    for (const unsigned word : words) {
      char letters[sizeof word];
      std::memcpy(letters, &word, sizeof word);
      name.append(letters, strnlen(letters, sizeof word));
    }
  };
  if (__get_cpuid(0, &a, &b, &c, &d) != 0) add({b, d, c});
  name += ' ';
  for (const unsigned leaf : {0x80000002u, 0x80000003u, 0x80000004u}) {
    if (__get_cpuid(leaf, &a, &b, &c, &d) != 0) add({a, b, c, d});
  }
  name.erase(name.find_last_not_of(' ') + 1);
  return Printable(name);
}

Json ToJson(const std::vector<StageBits>& bits) {
  Json stages;
  for (const StageBits& stage : bits) stages[stage.stage] = fmt::format("{:016x}", stage.hash);
  return stages;
}

BitsOfMake FromJson(const Json& entry) {
  BitsOfMake make{.commit = entry.at("commit").get<std::string>(), .stages = {}};
  for (const auto& [stage, hash] : entry.at("stages").items()) {
    make.stages.emplace_back(stage, hash.get<std::string>());
  }
  return make;
}

/// The list of makes, or an empty one where there is none yet. Throws InputError, also where it is
/// one of them that is not as it must be.
Json ReadMakes(const std::string& file, bool may_lack) {
  if (may_lack && !std::filesystem::exists(file)) return Json::object();
  try {
    Json makes = Json::parse(ReadFile(file)).at("makes");
    for (const auto& [make, entry] : makes.get_ref<const Json::object_t&>()) FromJson(entry);
    return makes;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": not a list of hashes by processor: " + error.what());
  }
}

/// The first stage that both have and that differs; empty where none does.
std::string FirstDifference(const BitsOfMake& own, const BitsOfMake& other) {
  const std::map<std::string, std::string> hashes(other.stages.begin(), other.stages.end());
  for (const auto& [stage, hash] : own.stages) {
    const auto at = hashes.find(stage);
    if (at != hashes.end() && at->second != hash) return stage;
  }
  return "";
}

}  // namespace

BitsVerdict HoldAgainst(const BitsOfMake& own, const BitsOfMake& known) {
  const std::string first = FirstDifference(own, known);
  if (first.empty()) return {.said = "all stages equal"};
  if (own.commit == known.commit) {
    return {.said = "first stage that differs: " + first, .differs = true};
  }
  return {.said = "made by another version of the program, not comparable from stage " + first +
                  " on: run `doctor --bits --keep` of this commit on that processor"};
}

int DoctorBits(const DoctorBitsOptions& options) {
  const std::string processor = ProcessorName();
  const std::string list =
      options.against.empty() ? BaselinePath("bits").string() : options.against;
  Json makes = ReadMakes(list, options.keep || options.against.empty());
  const std::vector<StageBits> bits = HashStages({.scene_file = SceneFile(kScene),
                                                  .assets_dir = AssetsDir().string(),
                                                  .threads = options.threads,
                                                  .drive = !options.pictures});
  const Json own = ToJson(bits);
  const std::string commit = OwnProvenance().commit;
  const Json entry = {{"commit", commit}, {"stages", own}};
  std::string text = fmt::format("{:14} {}\n", "processor", processor);
  for (const StageBits& stage : bits) {
    text += fmt::format("{:14} {:016x}\n", stage.stage, stage.hash);
  }
  bool differs = false;
  for (const auto& [make, known] : makes.items()) {
    const BitsOfMake there = FromJson(known);
    const BitsVerdict verdict = HoldAgainst(FromJson(entry), there);
    differs = differs || verdict.differs;
    text += fmt::format("{} (commit {}): {}\n", make, there.commit, verdict.said);
  }
  const std::string json = Dump({{"scene", kScene}, {"makes", {{processor, entry}}}});
  const bool json_alone = options.json && options.json_file.empty();
  fmt::print("{}", json_alone ? json : text);
  if (!options.json_file.empty()) WriteFileAtomically(options.json_file, json);
  if (options.keep) {
    makes[processor] = entry;
    WriteFileAtomically(list, Dump({{"scene", kScene}, {"makes", makes}}));
    return kAllPassed;
  }
  return differs ? kVerdictFailed : kAllPassed;
}

}  // namespace aisle
