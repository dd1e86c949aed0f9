#include "harness/cli/by_name.h"
#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/cli/early_checks.h"
#include "harness/cli/terminal.h"
#include "harness/contract/twin.h"
#include "harness/io/dataset.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/place_vocabulary.h"
#include "harness/plugs/recorded_sequence.h"
#include "harness/plugs/simulated_sequence.h"
#include "harness/suite/suite.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> sources;
  std::string out, format = "euroc", twin = twin::kEmpty;
  int frames = 16, threads = 0;
  std::uint64_t seed = 1;
};

/// A scene under a seed of its own, so that no two scenes share their layout's dice, or a folder.
std::unique_ptr<Sequence> Open(const std::string& source, std::uint64_t seed,
                               const Options& options) {
  if (fs::is_directory(source)) {
    return OpenRecording(source, DatasetFormatFromName(options.format));
  }
  return OpenSimulation({.scene_file = source,
                         .scene_name = SceneName(source),
                         .assets_dir = AssetsDir().string(),
                         .twin = options.twin,
                         .seed = seed,
                         .threads = options.threads});
}

/// `count` frames, evenly over the whole sequence.
std::vector<FrameRequest> Sparse(const std::vector<FrameRequest>& schedule, std::size_t count) {
  std::vector<FrameRequest> chosen;
  count = std::min(count, schedule.size());
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(schedule[i * schedule.size() / count]);
  return chosen;
}

/// All of them, before the first is rendered. Throws InputError.
void CheckSources(const Options& options) {
  CheckAreThere(options.sources);
  std::vector<std::string> scenes;
  for (const std::string& source : options.sources) {
    if (fs::is_directory(source)) {
      OpenRecording(source, DatasetFormatFromName(options.format));
    } else {
      scenes.push_back(source);
    }
  }
  CheckSceneFiles(scenes);
}

int Train(const Options& options) {
  CheckCanBeWritten(options.out);
  CheckSources(options);
  std::vector<cv::Mat1b> images;
  ProgressLine line;
  for (std::size_t i = 0; i < options.sources.size(); ++i) {
    const std::string& source = options.sources[i];
    const auto sequence = Open(source, options.seed + i, options);
    for (const FrameRequest& request :
         Sparse(sequence->Schedule(), static_cast<std::size_t>(options.frames))) {
      images.push_back(sequence->At(request).images.left);
      line.Show(fmt::format("{}: {} images in all", source, images.size()));
    }
  }
  line.Clear();
  if (images.empty()) throw InputError("vocabulary train: no frames in the sources");
  const int words = TrainPlaceVocabulary(images, options.out);
  fmt::print("{}: {} words from {} images, {} bytes\n", options.out, words, images.size(),
             fs::file_size(options.out));
  return kAllPassed;
}

}  // namespace

void AddVocabularyCommand(CLI::App* app, Action* action) {
  CLI::App* vocabulary = app->add_subcommand(
      "vocabulary", "Make the vocabulary of visual words by which places are recognised");
  vocabulary->require_subcommand(1);
  vocabulary->footer("Example: ./aisle vocabulary train scenes/paper/*.yaml --out warehouse.voc");
  const auto options = std::make_shared<Options>();
  CLI::App* train =
      vocabulary->add_subcommand("train", "Train a vocabulary on scenes or recordings");
  train->add_option("SOURCES", options->sources, "Scenes and folders of recordings")
      ->required()
      ->transform(ByName());
  AddOutput(train, &options->out, "File to write the vocabulary to")->required();
  train
      ->add_option("--frames", options->frames,
                   "Frames to take of each source, evenly spread; default: 16")
      ->check(CLI::Range(1, 10000));
  AddFolderFormat(train, &options->format);
  AddTwin(train, &options->twin);
  train->add_option("--seed", options->seed,
                    "Seed of the first scene, one more for each scene after it; default: 1");
  AddThreads(train, &options->threads, "never changes a bit of the file");
  train->callback([=] { *action = [=] { return Train(*options); }; });
}

}  // namespace aisle
