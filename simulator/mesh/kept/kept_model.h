#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "simulator/mesh/import.h"

namespace aisle::sim {

/// What an imported model's own file ends with.
inline constexpr const char* kKeptExtension = ".aislemesh";

/// Where a model comes from and what became of it; stands beside its file as FILE.json.
struct ModelRecord {
  std::string source;       ///< name of the file it was made of
  std::string source_hash;  ///< of its bytes: XXH3, 64 bits, in hexadecimal digits
  std::string licence;      ///< as the user says it
  std::string hash;         ///< of the model's own file, likewise
  double unit_m = 0;        ///< as given; 0: the file's own
  std::string up;           ///< as given; empty: the file's own
  std::array<double, 3> low_m = {0, 0, 0}, high_m = {0, 0, 0};  ///< its bounds at rest, z up
  std::size_t triangles = 0;
  std::vector<std::string> left_out;  ///< phrases
};

/// XXH3, 64 bits, of a file's bytes in hexadecimal digits. Throws ImportError.
std::string HashOfModelFile(const std::filesystem::path& file);

/// Writes the model as this project's own bytes and its record beside it, which becomes complete:
/// hash, bounds, triangles and what was left out. Both are there or, after an error, neither is
/// new. Throws ImportError where a file cannot be written.
ModelRecord KeepModel(const Model& model, ModelRecord record, const std::filesystem::path& file);

/// The record beside a model's own file. Throws ImportError where there is none, it is not one, or
/// it is another file's: their hashes differ.
ModelRecord ReadModelRecord(const std::filesystem::path& file);

/// A user's model: one that was kept, held to its record and to CheckModel, or a .glb or .gltf as
/// it is, read behind the door (simulator/mesh/door), which says its unit and which way is up. Its
/// bytes are all that it is: one that names other files has to be imported first, as other formats
/// have. Throws ImportError.
Model OpenUserModel(const std::filesystem::path& file, const ImportOptions& options = {});

/// What of a user's model is wrong without opening it: a file that is not there, a format that has
/// to be imported first, a record that does not fit. Throws ImportError.
void CheckUserModel(const std::filesystem::path& file);

}  // namespace aisle::sim
