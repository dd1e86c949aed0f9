#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace aisle {

// Options that several commands have: one check and one sentence each. Every sentence stands alone,
// as `--help` shows it, and the defaults are those that the values have when they are added.

/// `--threads`, at most 1024 and 0 for all that the machine has. `note`: what else is to be said,
/// such as "never changes a result". `what`: "Number of threads" of something.
CLI::Option* AddThreads(CLI::App* command, int* threads, const std::string& note,
                        const std::string& what = "Number of threads");

/// `--seed` of a scene's layout and sensor.
CLI::Option* AddSeed(CLI::App* command, std::uint64_t* seed);

/// `--twin`: one of TwinNames().
CLI::Option* AddTwin(CLI::App* command, std::string* twin);

/// `--twins`: names that the suites check, where the command loads them.
CLI::Option* AddTwins(CLI::App* command, std::vector<std::string>* twins);

/// `--format` of a recording's folder: euroc or kitti. `usual`: the one that is taken where the
/// value is empty.
CLI::Option* AddFolderFormat(CLI::App* command, std::string* format,
                             const std::string& usual = "euroc");

/// `--isa`: the instruction set that the tracer uses, of those it has code for.
CLI::Option* AddIsa(CLI::App* command, std::string* isa);

/// The flag `--json`. `what`: what is printed then, and instead of what.
CLI::Option* AddJson(CLI::App* command, bool* json,
                     const std::string& what = "Print JSON instead of text");

/// `--json-file`, which is called `--json` too: a file that a command writes beside its output.
/// `what` completes "Also write … to this JSON file".
CLI::Option* AddJsonFile(CLI::App* command, std::string* file, const std::string& what);

/// `-o`, `--out` or `--output`.
CLI::Option* AddOutput(CLI::App* command, std::string* output, const std::string& what);

/// `--frames-dir`: a folder of rendered frames that is used and added to.
CLI::Option* AddFramesDir(CLI::App* command, std::string* folder);

}  // namespace aisle
