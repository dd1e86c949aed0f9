#include <filesystem>

#include "harness/cli/command.h"
#include "harness/cli/common_options.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/user_model.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".aislemesh";

struct Options {
  UserModelRequest request;
  std::string unit, up;
};

const std::map<std::string, double>& Units() {
  static const std::map<std::string, double> units = {
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  return units;
}

std::string OutputFor(const Options& options) {
  if (!options.request.output.empty()) return options.request.output;
  return fs::path(options.request.file).stem().string() + kExtension;
}

void PrintList(const char* what, const std::vector<std::string>& items) {
  constexpr std::size_t kMost = 12;
  if (items.empty()) return;
  std::string line;
  for (std::size_t i = 0; i < std::min(items.size(), kMost); ++i) {
    line += (i > 0 ? ", " : "") + Printable(items[i], 60);
  }
  if (items.size() > kMost) line += fmt::format(" and {} more", items.size() - kMost);
  fmt::print("{}: {}\n", what, line);
}

/// A size that few things have is rather a unit that was not meant.
void WarnOfSize(double largest_m) {
  if (largest_m >= 0.02 && largest_m <= 500) return;
  fmt::print(
      "the mesh is {:.3g} m large; if that is wrong, set its unit: --unit m, cm, mm, in or ft\n",
      largest_m);
}

int ImportMesh(Options options) {
  UserModelRequest& request = options.request;
  request.output = OutputFor(options);
  if (fs::path(request.output).extension() != kExtension) {
    throw InputError(
        fmt::format("--output {}: expected a name that ends with {}", request.output, kExtension));
  }
  if (!options.unit.empty()) request.unit_m = Units().at(options.unit);
  if (!options.up.empty()) request.up = options.up.front();
  const UserModel model = TakeInUserModel(request);
  std::array<double, 3> size{};
  for (std::size_t i = 0; i < 3; ++i) size[i] = model.high_m[i] - model.low_m[i];
  fmt::print("{}: {} triangles, {} materials, {} textures; licence {}\n", request.output,
             model.triangles, model.materials, model.textures, request.licence);
  fmt::print(
      "bounds: x {:.3f} to {:.3f}, y {:.3f} to {:.3f}, z {:.3f} to {:.3f} m; {:.3f} x {:.3f} x "
      "{:.3f} m\n",
      model.low_m[0], model.high_m[0], model.low_m[1], model.high_m[1], model.low_m[2],
      model.high_m[2], size[0], size[1], size[2]);
  WarnOfSize(*std::ranges::max_element(size));
  PrintList("nodes", model.nodes);
  PrintList("animations", model.clips);
  PrintList("skipped", model.left_out);
  const std::string picture = fs::path(request.output).replace_extension(".png").string();
  WriteImage(picture, model.picture);
  fmt::print("{}: on a floor with a line every {:g} m\n", picture, model.grid_m);
  return kAllPassed;
}

}  // namespace

void AddImportMeshCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("import-mesh", "Import your own mesh for use in scenes");
  command->add_option("FILE", options->request.file, "Mesh file: .glb, .gltf, .obj or .dae")
      ->required();
  command
      ->add_option("--licence", options->request.licence,
                   "Licence under which you have the mesh, recorded beside it, for example "
                   "CC-BY-4.0 or own")
      ->required()
      ->check([](const std::string& text) {
        return text.empty() || text.size() > 200 ? "expected 1 to 200 characters" : "";
      });
  command
      ->add_option("--unit", options->unit,
                   "Unit of the file's lengths; needed if the file does not state it")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "ft"}));
  command
      ->add_option("--up", options->up,
                   "Axis of the file that points up; needed if the file does not state it")
      ->check(CLI::IsMember({"x", "y", "z"}));
  command->add_flag("--skinned", options->request.skinned,
                    "Keep skeleton and animations, for a person; default: freeze it in its rest "
                    "pose");
  AddOutput(command, &options->request.output,
            "File to write, with a record and a picture beside it; default: FILE's name with "
            ".aislemesh, in this folder");
  command->footer("Example: ./aisle import-mesh shelf.obj --unit mm --up z --licence own");
  command->callback([=] { *action = [=] { return ImportMesh(*options); }; });
}

}  // namespace aisle
