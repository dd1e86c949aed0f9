#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "harness/contract/exit_code.h"

namespace aisle {

/// What the chosen command will do; returns an exit code.
using Action = std::function<int()>;

// Each adds one command to the program; when it is chosen, `*action` is set.
void AddRunCommand(CLI::App* app, Action* action);
void AddRunOneCommand(CLI::App* app, Action* action);
void AddRerunCommand(CLI::App* app, Action* action);
void AddMergeCommand(CLI::App* app, Action* action);
void AddSystemsCommand(CLI::App* app, Action* action);
void AddScoreCommand(CLI::App* app, Action* action);
void AddScoresCommand(CLI::App* app, Action* action);
void AddCheckCommand(CLI::App* app, Action* action);
void AddImportMeshCommand(CLI::App* app, Action* action);
void AddPreviewCommand(CLI::App* app, Action* action);
void AddGalleryCommand(CLI::App* app, Action* action);
void AddRenderCommand(CLI::App* app, Action* action);
void AddSlamCommand(CLI::App* app, Action* action);
void AddVocabularyCommand(CLI::App* app, Action* action);
void AddBenchCommand(CLI::App* app, Action* action);
void AddReportCommand(CLI::App* app, Action* action);
void AddDoctorCommand(CLI::App* app, Action* action);
void AddCompletionCommand(CLI::App* app, Action* action);
void AddCompareCommand(CLI::App* app, Action* action);
void AddBaselineCommand(CLI::App* app, Action* action);
void AddBisectCommand(CLI::App* app, Action* action);

// Commands of `bench`.
void AddBenchAccuracy(CLI::App* bench, Action* action);
void AddBenchDynamic(CLI::App* bench, Action* action);
void AddBenchGrowth(CLI::App* bench, Action* action);
void AddBenchLight(CLI::App* bench, Action* action);
void AddBenchRealism(CLI::App* bench, Action* action);
void AddBenchRender(CLI::App* bench, Action* action);
void AddBenchSensitivity(CLI::App* bench, Action* action);
void AddBenchSearch(CLI::App* bench, Action* action);
void AddBenchSlam(CLI::App* bench, Action* action);

}  // namespace aisle
