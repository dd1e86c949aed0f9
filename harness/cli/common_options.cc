#include "harness/cli/common_options.h"

#include <fmt/ranges.h>

#include "harness/plugs/simulated_sequence.h"

namespace aisle {

CLI::Option* AddThreads(CLI::App* command, int* threads, const std::string& note,
                        const std::string& what) {
  const std::string rest = note.empty() ? "" : "; " + note;
  return command->add_option("--threads", *threads, what + "; 0: all of this machine" + rest)
      ->check(CLI::Range(0, 1024));
}

CLI::Option* AddSeed(CLI::App* command, std::uint64_t* seed) {
  return command->add_option(
      "--seed", *seed,
      fmt::format("Seed of the scene's layout and of the sensor; default: {}", *seed));
}

CLI::Option* AddTwin(CLI::App* command, std::string* twin) {
  return command->add_option("--twin", *twin, fmt::format("Twin of the scene; default: {}", *twin))
      ->check(CLI::IsMember(TwinNames()));
}

CLI::Option* AddTwins(CLI::App* command, std::vector<std::string>* twins) {
  return command
      ->add_option("--twins", *twins,
                   fmt::format("Twins to run, of {}; default: those of the suite",
                               fmt::join(TwinNames(), ", ")))
      ->delimiter(',');
}

CLI::Option* AddFolderFormat(CLI::App* command, std::string* format, const std::string& usual) {
  return command
      ->add_option("--format", *format,
                   fmt::format("Layout of a recording's folder; default: {}",
                               format->empty() ? usual : *format))
      ->check(CLI::IsMember({"euroc", "kitti"}));
}

CLI::Option* AddIsa(CLI::App* command, std::string* isa) {
  return command
      ->add_option("--isa", *isa,
                   fmt::format("Instruction set that the ray tracer uses; default: {}", *isa))
      ->check(CLI::IsMember({"avx2", "native"}));
}

CLI::Option* AddJson(CLI::App* command, bool* json, const std::string& what) {
  return command->add_flag("--json", *json, what);
}

CLI::Option* AddJsonFile(CLI::App* command, std::string* file, const std::string& what) {
  return command->add_option("--json,--json-file", *file,
                             fmt::format("Also write {} to this JSON file", what));
}

CLI::Option* AddOutput(CLI::App* command, std::string* output, const std::string& what) {
  return command->add_option("-o,--out,--output", *output, what);
}

CLI::Option* AddFramesDir(CLI::App* command, std::string* folder) {
  return command->add_option(
      "--frames-dir", *folder,
      "Keep rendered frames in this folder and use those that are already there, whichever version "
      "of the program rendered them");
}

}  // namespace aisle
