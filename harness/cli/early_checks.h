#pragma once

#include <string>
#include <vector>

namespace aisle {

// Asked before work that takes minutes, of what would end it only then.

/// Every mistake of every scene. Throws InputError with all of them.
void CheckSceneFiles(const std::vector<std::string>& files);

/// A file that is written at the end; empty: none. Makes the folder that it goes to. Throws
/// InputError.
void CheckCanBeWritten(const std::string& file);

}  // namespace aisle
