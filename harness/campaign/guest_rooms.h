#pragma once

#include <filesystem>

#include "harness/io/file.h"

namespace aisle {

/// The folders of one foreign system in one run. Only the three may it write to.
struct GuestRooms {
  explicit GuestRooms(const std::filesystem::path& at)
      : folder(std::filesystem::absolute(at).lexically_normal()),
        dataset(folder / "dataset"),
        output(folder / "output"),
        temporary(folder / "tmp") {
    RemoveFolder(folder);
    for (const std::filesystem::path& room : {dataset, output, temporary})
      std::filesystem::create_directories(room);
  }
  ~GuestRooms() { RemoveFolder(folder); }
  GuestRooms(const GuestRooms&) = delete;
  GuestRooms& operator=(const GuestRooms&) = delete;

  const std::filesystem::path folder, dataset, output, temporary;
};

}  // namespace aisle
