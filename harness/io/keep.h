#pragma once

#include <functional>

namespace aisle {

/// Writes what is kept for others to find, or goes on without: a cache that cannot be written (the
/// disk is full, another night has just taken the folder away) costs time, not what is in hand.
/// MachineError and InputError are said on stderr, once in this process.
void KeepWherePossible(const std::function<void()>& write);

}  // namespace aisle
