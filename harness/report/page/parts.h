#pragma once

#include <string>
#include <vector>

#include "harness/record/group.h"

namespace aisle {

// What several sections of a page are made of.

/// Begins the ids of a scene's headings, on a page that may hold all scenes and twins: as unlike as
/// the folders of their runs.
std::string SceneId(const SceneRuns& scene);

/// A system's mark: the colour and shape of its style, as its lines and points have them.
std::string Chip(int style);
/// Mark and name, made harmless.
std::string NameOf(const SystemRuns& system);

/// A chart with a sentence below it; empty where there is no chart.
std::string Figure(const std::string& content, const std::string& caption);

/// "a, b and c".
std::string Listed(const std::vector<std::string>& parts);

/// The runs that came to their end (IsComplete); all of them where none has.
std::vector<const RunRecord*> CompleteOf(const std::vector<const RunRecord*>& runs);

/// "2 of 18 runs failed, 1 lost", "1 of 18 runs lost": failed is what did not come to its end
/// (IsComplete), lost what did with too few poses. Empty where every run is well.
std::string FailedAndLost(const std::vector<const RunRecord*>& runs);
std::string FailedAndLost(const std::vector<RunRecord>& runs);

/// "seed 3", "seed 3, drive 2 over it".
std::string SeedOf(const RunSpec& spec);

/// What a foreign system, or a run that failed, said last, folded away; empty where it said
/// nothing. `root` leads from the page to the report's folder.
std::string LastWordsOf(const RunRecord& run, const std::string& root);

}  // namespace aisle
