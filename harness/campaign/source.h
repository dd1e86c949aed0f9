#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "harness/contract/sequence.h"

namespace aisle {

// What a run takes its frames from, a scene or a recording: one set of questions for both.

/// A recording with its truth. Throws InputError.
std::unique_ptr<Sequence> OpenRecordingSource(const std::string& file);

/// Every mistake in it, one message each.
std::vector<std::string> CheckSource(const std::string& file);

/// What a reader of a recording should know: that its bag ends too early, say. Throws InputError.
std::vector<std::string> NotesOfSource(const std::string& file);

/// Whether the system under test steers through it.
bool IsDriveSource(const std::string& file);

/// The hall that a seed of a scene is in ("cold_store"); empty where it is the scene's own, and of
/// a recording. Throws InputError.
std::string HallOfSource(const std::string& file, std::uint64_t seed);

/// Frames that a run of it has. Throws InputError.
std::int64_t CountSourceFrames(const std::string& file);

/// The files that decide what it holds, nearest first: a scene's and those it extends; a
/// recording's, with the truth that a reader finds beside it or behind its links.
std::vector<std::string> FilesOfSource(const std::string& file);

/// Hash of all that decides the frames of that twin but program and assets: of a scene what can be
/// seen of it, wherever it stands written, so that scenes which differ in actors alone share their
/// `empty` twin; of a recording names, sizes and times of change of all its files and of its truth,
/// since it may be larger than memory. Throws InputError where its folder holds a million files.
std::uint64_t HashSource(const std::string& file, const std::string& twin, std::uint64_t seed);

}  // namespace aisle
