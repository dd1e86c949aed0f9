#pragma once

#include <filesystem>
#include <functional>

#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

struct GuestDataset {
  std::filesystem::path kept;  ///< exported there once, for all guests of these frames
  ExportOptions options;
  std::function<PathOfRig()> open_path;  ///< called only when it must be exported
};

/// Lays the dataset of a sequence, its truth left out, into a folder that is the guest's alone:
/// whatever it does to it meets nobody else. What is copied is held against the checksum of what
/// was exported; where somebody changed it since, it is exported anew. Any number of processes may
/// do so at once. Throws MachineError.
void LayOutDataset(const Sequence& sequence, const GuestDataset& dataset,
                   const std::filesystem::path& into);

}  // namespace aisle
