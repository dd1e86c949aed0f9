#pragma once

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "harness/io/input_error.h"

namespace aisle {

/// What the simulator answers; what it throws as whose fault it is: InputError for what files hold,
/// MachineError where there were no memory, too many open files or no process to read a model in.
template <class Question>
auto AskSimulator(const Question& question) {
  try {
    return question();
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(error.what());
  } catch (const std::system_error& error) {
    throw MachineError(error.what());
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

}  // namespace aisle
