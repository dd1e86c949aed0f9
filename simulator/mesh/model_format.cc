#include "simulator/mesh/model_format.h"

#include <cctype>

#include "simulator/mesh/import.h"
#include "simulator/mesh/obj_check.h"

namespace aisle::sim {
namespace {

struct FormatNames {
  ModelFormat format;
  const char* extension;
  const char* what;
};

constexpr std::array<FormatNames, 4> kFormats = {
    {{ModelFormat::kGlb, ".glb", "a binary glTF file (it begins with glTF)"},
     {ModelFormat::kGltf, ".gltf", "glTF's JSON"},
     {ModelFormat::kObj, ".obj", "OBJ text"},
     {ModelFormat::kCollada, ".dae", "COLLADA"}}};

const FormatNames& NamesOf(ModelFormat format) {
  return *std::ranges::find(kFormats, format, &FormatNames::format);
}

ModelFormat FormatNamed(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::ranges::find_if(
      kFormats, [&](const FormatNames& names) { return extension == names.extension; });
  if (found == kFormats.end()) throw ImportError("models are .glb, .gltf, .obj or .dae files");
  return found->format;
}

/// The name of an XML text's root element, without prefix; empty when there is none.
std::string_view RootElement(std::string_view text) {
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::string_view rest = text.substr(at + 1);
    if (rest.starts_with("!--")) {  // a comment may hold anything
      at = text.find("-->", at);
      if (at == std::string_view::npos) break;
      continue;
    }
    if (rest.starts_with("?") || rest.starts_with("!")) continue;
    const std::string_view name = rest.substr(0, rest.find_first_of(" \t\r\n/>"));
    return name.substr(name.find(':') == std::string_view::npos ? 0 : name.find(':') + 1);
  }
  return {};
}

std::optional<ModelFormat> FormatHeld(std::string_view text) {
  if (text.starts_with("glTF")) return ModelFormat::kGlb;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  if (text[first] == '{') return ModelFormat::kGltf;
  if (text[first] == '<' && RootElement(text) == "COLLADA") return ModelFormat::kCollada;
  if (LooksLikeObj(text)) return ModelFormat::kObj;
  return std::nullopt;
}

}  // namespace

ModelFormat FormatOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& file) {
  const ModelFormat named = FormatNamed(file);
  const FormatNames& wanted = NamesOf(named);
  if (bytes.empty()) throw ImportError("it is empty; export it again");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::optional<ModelFormat> held = FormatHeld(text);
  if (!held && named == ModelFormat::kObj) held = named;  // its own check names the line
  if (!held) {
    throw ImportError(
        fmt::format("it is named {}, but does not hold {}, nor any other model that "
                    "is read; export it again, best as .glb",
                    wanted.extension, wanted.what));
  }
  if (*held != named) {
    const FormatNames& is = NamesOf(*held);
    throw ImportError(fmt::format(
        "it is named {}, but holds {}; rename it to {}", wanted.extension, is.what,
        std::filesystem::path(file).replace_extension(is.extension).filename().string()));
  }
  return *held;
}

}  // namespace aisle::sim
