#pragma once

#include "simulator/mesh/door/confine.h"
#include "simulator/mesh/import.h"

namespace aisle::sim {

/// The door through which models of others come in.
struct ModelDoor {
  ReadingLimits limits;
  std::size_t most_bytes = std::size_t{1} << 30;  ///< of what comes back
  /// The program that reads; empty: ReaderProgram().
  std::filesystem::path program;
};

/// ImportModel in a process of its own, which may read the model's root and nothing else: whatever
/// the file does to its parser ends as one ImportError here. What comes back is bounded, carries a
/// checksum and is held to CheckModel. The same model to the last bit, the same errors. Throws
/// ImportError, and std::system_error where the machine fails the process.
Model ReadModel(const std::filesystem::path& file, const ImportOptions& options = {},
                const ModelDoor& door = {});

/// `aisle-read-model` beside the running program, or where this build has put it.
std::filesystem::path ReaderProgram();

/// What a reader ends with that met a picture and has no decoder: it is started again, with one.
inline constexpr int kNeedsPictures = 6;

/// The reader's side: reads the file that the arguments name, within its limits, and writes the
/// model's bytes to stdout or one line to stderr. Returns the exit code. Calls `load_pictures`,
/// which makes pictures readable and may throw, where it is told that there are some: before it is
/// confined, when it may still open libraries.
int RunReadModel(int argc, const char* const* argv, void (*load_pictures)());

}  // namespace aisle::sim
