#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "harness/contract/sequence.h"
#include "harness/contract/twin.h"

namespace aisle {

/// Where a bench takes its frames from.
struct BenchSource {
  std::string format = "euroc";    ///< of a recording
  std::string twin = twin::kLive;  ///< of a scene
  std::uint64_t seed = 1;          ///< of a scene
  std::string frames_dir = {};     ///< keeps what a scene renders; empty: nothing is kept
  int threads = 0;                 ///< 0: all
};

/// A stretch of a scene or of a recording's folder: frames from `from` on, `to` not included.
struct BenchView {
  std::string text;             ///< as it was asked for
  std::string path;             ///< the scene's file, or the recording's folder
  std::string scene = {};       ///< its name, "paper/scene2"; empty for a recording
  std::string assets_dir = {};  ///< meshes and textures of a scene; empty for a recording
  std::optional<std::uint64_t> seed = {};  ///< of this view; none: the source's
  int from = 0, to = std::numeric_limits<int>::max();
};

/// Throws InputError where none of the frames that were read lies in the view: a table of zeros
/// would look like a result.
void RefuseEmptyView(const BenchView& view, std::size_t frames);

/// Throws InputError where a source of so many frames has none or ends before the stretch does: a
/// table over fewer frames than its label says would look like one over all of them.
void RefuseOutside(const BenchView& view, std::size_t frames);

/// The seed of a view's scene: its own, or the source's.
std::uint64_t SeedOf(const BenchView& view, const BenchSource& source);

/// The whole scene or recording, in which the stretch must lie. Kept frames lie in a folder of
/// their own for each scene as it is written, twin and seed, and are used whichever program made
/// them. Throws InputError.
std::unique_ptr<Sequence> OpenSource(const BenchView& view, const BenchSource& source);

/// Told what a bench is at, a few words, as often as it gets on; may be empty.
using BenchProgress = std::function<void(const std::string& at)>;

}  // namespace aisle
