#include "simulator/mesh/import.h"

#include <numbers>
#include <system_error>

#include "simulator/mesh/bands.h"
#include "simulator/mesh/collada_check.h"
#include "simulator/mesh/confined_files.h"
#include "simulator/mesh/gltf_clips.h"
#include "simulator/mesh/gltf_left_out.h"
#include "simulator/mesh/gltf_materials.h"
#include "simulator/mesh/gltf_meshes.h"
#include "simulator/mesh/import_assimp.h"
#include "simulator/mesh/model_parts.h"
#include "simulator/mesh/obj_check.h"
#include "simulator/mesh/stated_frame.h"

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
  ForEachBand(options, model,
              [&](const ImportOptions& band) { AddGltfMaterials(document, file, band, model); });
  model->left_out = LeftOutOfGltf(document);
}

/// What stands above the file's own nodes: the turn to z up, if there is one, and its unit.
ModelNode TopNode(UpAxis up, ModelFrame frame, float scale) {
  ModelNode top;
  top.rest.scale *= scale;
  if (frame == ModelFrame::kAsStored || up == UpAxis::kZ) return top;
  constexpr float kQuarter = std::numbers::pi_v<float> / 2;
  top.rest.rotation = up == UpAxis::kX ? Eigen::AngleAxisf(-kQuarter, Eigen::Vector3f::UnitY())
                                       : Eigen::AngleAxisf(kQuarter, Eigen::Vector3f::UnitX());
  return top;
}

Model Import(const fs::path& file, const ImportOptions& options) {
  CheckFile(file, options);
  const Bytes bytes = ReadBytes(file);
  const ModelFormat format = FormatOf(bytes, file);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const StatedFrame stated = FrameStatedIn(format, text);
  if (options.must_state) RequireStated(stated, options);
  Model model;
  model.name = file.stem().string();
  // An importer has applied what the file states: an option takes its place.
  const float scale = options.unit_m > 0 ? options.unit_m / stated.unit_m.value_or(1) : 1;
  const UpAxis up = options.up == UpAxis::kAsStated ? UpAxis::kY : options.up;
  model.nodes.push_back(TopNode(up, options.frame, scale));
  if (format == ModelFormat::kGlb || format == ModelFormat::kGltf) {
    AddGltfModel(bytes, file, options, &model);
  } else {
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
  if (!(options.unit_m >= 0 && options.unit_m <= 1e4f)) options.unit_m = 0;
  try {
    return Import(file, options);
  } catch (const std::bad_alloc&) {
    // Whose fault it is depends on how much there was.
    throw std::system_error(std::make_error_code(std::errc::not_enough_memory), file.string());
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
