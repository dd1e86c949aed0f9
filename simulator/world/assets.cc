#include "simulator/world/assets.h"

#include <fmt/ranges.h>
#include <xxhash.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "simulator/common/own_files.h"
#include "simulator/mesh/door/read_model.h"
#include "simulator/mesh/kept/kept_model.h"
#include "simulator/mesh/still.h"

namespace aisle::sim {
namespace {

using Json = nlohmann::json;

BoxFacts ReadBox(const Json& box) {
  const auto size = box.at("size_m").get<std::array<float, 3>>();
  const auto centre = box.at("centre_m").get<std::array<float, 3>>();
  return {{size[0], size[1], size[2]}, {centre[0], centre[1], centre[2]}};
}

PersonFacts ReadPerson(const Json& asset) {
  PersonFacts facts;
  for (const auto& [name, clip] : asset.at("clips").items()) {
    ClipFacts one{clip.at("duration_s").get<double>(),
                  clip.value("stride_m", 0.0),
                  clip.value("speed_mps", 0.0),
                  clip.value("turn_deg", 0.0),
                  0,
                  {}};
    if (clip.contains("handle_m")) one.handle_ahead_m = clip["handle_m"].at(0);
    if (clip.contains("box")) one.box = ReadBox(clip["box"]);
    facts.clips[name] = one;
  }
  return facts;
}

VehicleFacts ReadVehicle(const Json& asset) {
  VehicleFacts facts;
  facts.wheel_radius_m = asset.at("wheel_radius_m").get<std::map<std::string, double>>();
  facts.steer_nodes = asset.value("steer_nodes", std::vector<std::string>{});
  if (asset.contains("lift")) {
    facts.lift_travel_m = asset["lift"].at("travel_m");
    for (const auto& [name, share] : asset["lift"].items()) {
      if (!name.ends_with("_m") && !name.ends_with("_mps")) facts.lift_shares[name] = share;
    }
  }
  if (asset.contains("handle_m")) facts.handle_m = asset["handle_m"].at(0);
  if (asset.contains("forks")) {
    facts.fork_node = asset["forks"].at("node");
    facts.fork_top_m = asset["forks"].at("top_z_m");
    facts.fork_heel_x_m = asset["forks"].at("heel_x_m");
  }
  if (asset.contains("ridden")) {
    const Json& ridden = asset["ridden"];
    facts.ridden = {ridden.at("clip"), ridden.at("development_m"), ridden.at("crank"),
                    ridden.at("pedals").get<std::vector<std::string>>()};
  }
  return facts;
}

void ReadRects(const std::string& texture, const Json& asset,
               std::map<std::string, std::array<float, 4>>* rects) {
  if (!asset.contains("rects_px")) return;
  const float width = asset.at("width"), height = asset.at("height");
  for (const auto& [name, rect] : asset["rects_px"].items()) {
    const auto [x, y, w, h] = rect.get<std::array<float, 4>>();
    (*rects)[texture + "/" + name] = {x / width, y / height, w / width, h / height};
  }
}

ImportOptions WithColour(bool colour) {
  ImportOptions options;
  options.colour = colour;
  return options;
}

std::uint64_t DigestOfFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  return XXH3_64bits(bytes.data(), bytes.size());
}

bool IsOwnTree(const std::filesystem::path& folder) {
  const std::filesystem::path own = FindOwnFolder(OwnFile());
  std::error_code error;
  return !own.empty() && std::filesystem::equivalent(folder, own / "assets", error);
}

template <class Facts>
std::vector<std::string> NamesOf(const std::map<std::string, Facts>& known) {
  std::vector<std::string> names;
  for (const auto& [name, unused] : known) names.push_back(name);
  return names;
}

template <class Facts>
const Facts& Find(const std::map<std::string, Facts>& known, const std::string& name,
                  const std::string& kind) {
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  throw std::runtime_error(fmt::format("there is no model '{}' in assets/{}; there are: {}", name,
                                       kind, fmt::join(NamesOf(known), ", ")));
}

}  // namespace

AssetLibrary::AssetLibrary(std::filesystem::path folder, bool colour)
    : folder_(std::move(folder)), is_own_(IsOwnTree(folder_)), colour_(colour) {
  const std::filesystem::path file = folder_ / "manifest.json";
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": there is no such file");
  digests_["manifest"] = DigestOfFile(file);
  try {
    const Json manifest = Json::parse(stream);
    for (const auto& [name, asset] : manifest.at("assets").items()) {
      const std::string kind = asset.value("kind", "");
      const std::string stem = name.substr(name.find('/') + 1);
      if (kind == "person") people_[stem] = ReadPerson(asset);
      if (kind == "texture") ReadRects(stem, asset, &rects_);
      if (kind == "kit" || kind == "street") props_[stem] = name;
      if (kind == "vehicle") vehicles_[stem] = ReadVehicle(asset);
    }
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

const PersonFacts& AssetLibrary::Person(const std::string& name) const {
  return Find(people_, name, "people");
}

std::vector<std::string> AssetLibrary::PeopleNames() const { return NamesOf(people_); }

std::vector<std::string> AssetLibrary::VehicleNames() const { return NamesOf(vehicles_); }

const VehicleFacts& AssetLibrary::Vehicle(const std::string& name) const {
  return Find(vehicles_, name, "vehicles");
}

const std::string& AssetLibrary::Prop(const std::string& name) const {
  return Find(props_, name, "kit and assets/street");
}

cv::Mat1b AssetLibrary::Picture(const std::string& texture) const {
  const cv::Mat picture = ColourPicture(texture);
  if (picture.empty()) {
    throw ImportError((folder_ / "textures" / (texture + ".png")).string() +
                      ": there is no such file");
  }
  return GreyOf(picture, Band::kLuminance);
}

cv::Mat AssetLibrary::ColourPicture(const std::string& texture) const {
  const std::filesystem::path file = folder_ / "textures" / (texture + ".png");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), {});
  return DecodeImage(bytes, file.string(), ImportOptions().max_texture_px);
}

std::array<float, 4> AssetLibrary::Rect(const std::string& texture, const std::string& name) const {
  const auto found = rects_.find(texture + "/" + name);
  if (found == rects_.end()) {
    throw std::runtime_error(
        fmt::format("{}: texture {} names no picture '{}'", folder_.string(), texture, name));
  }
  return found->second;
}

std::shared_ptr<const Model> AssetLibrary::Load(const std::string& asset) {
  std::shared_ptr<const Model>& model = models_[asset];
  if (!model) {
    ImportOptions options;
    options.root = folder_;
    options.colour = colour_;
    options.one_file = true;  // the digest is of its bytes
    const std::filesystem::path file = folder_ / (asset + ".glb");
    digests_[asset] = DigestOfFile(file);
    model = std::make_shared<const Model>(is_own_ ? ImportModel(file, options)
                                                  : ReadModel(file, options));
  }
  return model;
}

std::uint64_t AssetLibrary::Digest() const {
  std::string all;
  for (const auto& [name, digest] : digests_) all += fmt::format("{} {:016x}\n", name, digest);
  return XXH3_64bits(all.data(), all.size());
}

std::shared_ptr<const Model> AssetLibrary::LoadStill(const std::string& file) {
  std::shared_ptr<const Model>& model = models_["still:" + file];
  if (!model)
    model = std::make_shared<const Model>(StillOf(OpenUserModel(file, WithColour(colour_))));
  return model;
}

std::shared_ptr<const Model> AssetLibrary::LoadSkinned(const std::string& file) {
  std::shared_ptr<const Model>& model = models_["skinned:" + file];
  if (!model) model = std::make_shared<const Model>(OpenUserModel(file, WithColour(colour_)));
  return model;
}

}  // namespace aisle::sim
