#pragma once

#include <filesystem>
#include <string>

namespace aisle::sim {

/// The file that the build writes into its own folder: the source tree's path, in one line.
inline constexpr const char* kBuiltFrom = "aisle-built-from";

/// What comes with the program that runs from this file: PREFIX/share/aisle where it is installed,
/// the source tree where it was built; empty where neither is around it.
std::filesystem::path FindOwnFolder(const std::filesystem::path& executable);

/// A program of ours that no user calls: in PREFIX/libexec/aisle where the caller is installed, in
/// its build folder where it was built; empty where neither is around it. `built` is its place
/// there.
std::filesystem::path FindOwnHelper(const std::filesystem::path& executable,
                                    const std::string& name, const std::filesystem::path& built);

/// The file that this code was loaded from: the program's, or a module's within a program of others
/// (Python's).
std::filesystem::path OwnFile();

}  // namespace aisle::sim
