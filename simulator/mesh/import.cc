#include "simulator/mesh/import.h"

#include <numbers>

#include "simulator/mesh/collada_check.h"
#include "simulator/mesh/confined_files.h"
#include "simulator/mesh/gltf_clips.h"
#include "simulator/mesh/gltf_materials.h"
#include "simulator/mesh/gltf_meshes.h"
#include "simulator/mesh/import_assimp.h"
#include "simulator/mesh/model_parts.h"
#include "simulator/mesh/obj_check.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

/// Folders and sizes in order before the file is opened.
void CheckFile(const fs::path& file, const ImportOptions& options) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) throw ImportError("there is no such file");
  if (!IsInside(file, options.root)) {
    throw ImportError(fmt::format("it lies outside {}", options.root.string()));
  }
  if (fs::file_size(file, failed) > options.max_file_bytes) {
    throw ImportError(fmt::format("it is larger than {} bytes", options.max_file_bytes));
  }
}

void AddGltfModel(const Bytes& bytes, const fs::path& file, const ImportOptions& options,
                  Model* model) {
  const GltfDocument document = ParseGltf(bytes, file, options);
  const GltfNodes nodes = AddGltfNodes(document, model);
  AddGltfClips(document, nodes, options, model);
  AddGltfMeshes(document, nodes, options, model);
  AddGltfMaterials(document, file, options, model);
}

/// What stands above the file's own nodes: the turn from y up to z up, or nothing.
ModelNode TopNode(ModelFrame frame) {
  ModelNode top;
  if (frame == ModelFrame::kZUp) {
    top.rest.rotation = Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Eigen::Vector3f::UnitX());
  }
  return top;
}

Model Import(const fs::path& file, const ImportOptions& options) {
  CheckFile(file, options);
  const Bytes bytes = ReadBytes(file);
  const ModelFormat format = FormatOf(bytes, file);
  Model model;
  model.name = file.stem().string();
  model.nodes.push_back(TopNode(options.frame));
  if (format == ModelFormat::kGlb || format == ModelFormat::kGltf) {
    AddGltfModel(bytes, file, options, &model);
  } else {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    format == ModelFormat::kObj ? CheckObj(text) : CheckCollada(text);
    AddAssimpModel(file, format, options, &model);
  }
  FinishModel(options, &model);
  return model;
}

/// What a file's own words made of an error, fit for one line of a terminal.
std::string OneLine(std::string text) {
  constexpr std::size_t kLongest = 400;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

}  // namespace

Model ImportModel(const fs::path& file, const ImportOptions& given) {
  ImportOptions options = given;
  if (options.root.empty()) options.root = fs::absolute(file).parent_path();
  try {
    return Import(file, options);
  } catch (const std::bad_alloc&) {
    throw ImportError(fmt::format("{}: it asks for more memory than there is", file.string()));
  } catch (const std::exception& error) {
    throw ImportError(fmt::format("{}: {}", file.string(), OneLine(error.what())));
  }
}

int Model::FindNode(const std::string& name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

int Model::FindClip(const std::string& name) const {
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (clips[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace aisle::sim
