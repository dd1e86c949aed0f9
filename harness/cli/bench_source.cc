#include "harness/cli/bench_source.h"

#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/suite/suite.h"

namespace aisle {

void AddSourceOptions(CLI::App* command, BenchSource* source) {
  command
      ->add_option("--format", source->format,
                   fmt::format("of a folder: euroc or kitti; default {}", source->format))
      ->check(CLI::IsMember({"euroc", "kitti"}));
  command->add_option("--twin", source->twin,
                      fmt::format("of a scene: live, empty or frozen; default {}", source->twin));
  command->add_option("--seed", source->seed, "of a scene; default 1");
  command->add_option(
      "--frames-dir", source->frames_dir,
      "keep rendered frames there and use what is there, whichever program made it");
  command->add_option("--threads", source->threads, "0: all");
}

BenchView ParseView(const std::string& text) {
  BenchView view{.text = text, .path = {}};
  std::string source = text;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    source = text.substr(0, colon);
    char rest = 0;
    if (std::sscanf(text.c_str() + colon + 1, "%d-%d%c", &view.from, &view.to, &rest) != 2 ||
        view.from < 0 || view.to <= view.from) {
      throw InputError(Printable(text) +
                       ": expected SOURCE:FROM-TO, for example paper/scene2:90-130");
    }
  }
  view.path = SceneFile(source);
  if (!std::filesystem::exists(view.path)) {
    throw InputError(Printable(source) +
                     ": neither a scene (a file, or a name like paper/scene2) nor the folder of a "
                     "recording");
  }
  if (std::filesystem::is_directory(view.path)) return view;
  view.scene = SceneName(view.path);
  view.assets_dir = AssetsDir().string();
  return view;
}

}  // namespace aisle
