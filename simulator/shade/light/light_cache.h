#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "simulator/shade/light/light_state.h"
#include "simulator/world/world.h"

namespace aisle::sim {

struct StaticLightOptions;

/// The user's folder for solved light: $AISLE_CACHE, else $XDG_CACHE_HOME/aisle, else
/// $HOME/.cache/aisle; empty when none of them is set.
std::filesystem::path DefaultLightCache();

/// Hash of all that decides a solution, and of nothing else: the static mesh, what its surfaces
/// reflect and emit, the lamps and their setting, and the options. Movers and their materials do
/// not enter, nor does the order of materials: the twins of a scene share a solution. The sky,
/// which is all that shines without a lamp, goes with the setting of all lamps at full and with no
/// other, unless `sky_taken` takes it away from that one too.
std::uint64_t LightKey(const World& world, const StaticLightOptions& options,
                       std::span<const float> light_scale, bool sky_taken = false);

/// Whether there seems to be a kept solution.
bool HasLight(const std::filesystem::path& folder, std::uint64_t key);

/// Where who solves it holds his LightLock.
std::filesystem::path LockFileOf(const std::filesystem::path& folder, std::uint64_t key);

/// Where he keeps what he has of it. SaveLight takes it away.
std::filesystem::path UnfinishedFileOf(const std::filesystem::path& folder, std::uint64_t key);

/// A kept solution, or nothing when there is none, or it is damaged, or of another size.
std::optional<LightState> LoadLight(const std::filesystem::path& folder, std::uint64_t key,
                                    std::size_t slots);

/// Deletes kept and unfinished solutions, least recently used first, until at most `most_bytes`
/// remain; the last used one stays whatever its size. Who is reading one reads on; who comes later
/// solves again.
void ShrinkLight(const std::filesystem::path& folder, std::uintmax_t most_bytes);

/// Keeps a solution, written aside and renamed; what another left aside when it died goes. A folder
/// that cannot be written is no error: the next run solves again.
void SaveLight(const std::filesystem::path& folder, std::uint64_t key, const LightState& state);

}  // namespace aisle::sim
