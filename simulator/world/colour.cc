#include "simulator/world/colour.h"

#include <cmath>

#include "simulator/mesh/import.h"

namespace aisle::sim {
namespace {

constexpr std::array kBands = {Band::kRed, Band::kGreen, Band::kBlue};

/// Of things whose sheets are grey: red, green and blue of weight 1 in luminance (Rec. 709).
struct Tint {
  const char* name;
  std::array<float, 3> rgb;
};
constexpr std::array<Tint, 2> kTints = {{
    {"cartons", {1.31f, 0.96f, 0.48f}},      // corrugated board, after a colour chart's cardboard
    {"wood_pallet", {1.24f, 0.97f, 0.59f}},  // spruce that has been outdoors
}};

/// The value that sRGB encodes; not the standard's straight foot, which a share does not need.
float Linear(std::uint8_t value) { return std::pow(static_cast<float>(value) / 255, 2.2f); }

/// `worn`, which was made of the grey of a coloured picture, in one of that picture's bands: each
/// pixel keeps the picture's share of band and grey.
cv::Mat1b InBand(const cv::Mat1b& worn, const cv::Mat& picture, Band band) {
  const cv::Mat1b grey = GreyOf(picture, Band::kLuminance), one = GreyOf(picture, band);
  cv::Mat1b out(worn.size());
  for (int y = 0; y < worn.rows; ++y) {
    for (int x = 0; x < worn.cols; ++x) {
      constexpr float kDarkest = 1e-4f;
      const float share = Linear(one(y, x)) / std::max(Linear(grey(y, x)), kDarkest);
      const float value = 255 * std::pow(std::min(Linear(worn(y, x)) * share, 1.0f), 1 / 2.2f);
      out(y, x) = static_cast<std::uint8_t>(std::lround(value));
    }
  }
  return out;
}

bool IsWorn(std::size_t texture, const std::vector<Wardrobe::Worn>& worn) {
  return std::ranges::any_of(worn, [&](const Wardrobe::Worn& one) {
    return texture >= one.first_texture && texture < one.first_texture + one.model->textures.size();
  });
}

void DressModel(const Wardrobe::Worn& worn, std::size_t band, BandSurfaces* surfaces) {
  if (worn.model->colour.empty()) return;
  const ModelSurfaces& own = worn.model->colour[band];
  for (std::size_t i = 0; i < own.materials.size(); ++i) {
    Material& material = surfaces->materials[worn.first_material + i];
    material.albedo = own.materials[i].albedo;
    material.specular_f0 = own.materials[i].specular_f0;
    material.emission = own.materials[i].emission;
  }
  for (std::size_t i = 0; i < own.textures.size(); ++i) {
    surfaces->textures[worn.first_texture + i].image = own.textures[i].image;
  }
}

/// The kit's own texture of that index.
void DressSheet(std::size_t texture, const cv::Mat& picture, std::size_t band,
                BandSurfaces* surfaces) {
  Texture& sheet = surfaces->textures[texture];
  if (picture.channels() >= 3 && picture.size() == sheet.image.size()) {
    sheet.image = InBand(sheet.image, picture, kBands[band]);
    return;
  }
  for (const Tint& tint : kTints) {
    if (sheet.name != tint.name) continue;
    for (Material& material : surfaces->materials) {
      if (material.albedo_texture != static_cast<int>(texture)) continue;
      material.albedo *= tint.rgb[band];
    }
  }
}

}  // namespace

std::vector<BandSurfaces> ColourOf(const WorldParts& parts, const std::vector<Wardrobe::Worn>& worn,
                                   const AssetLibrary& assets) {
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < parts.textures.size(); ++i) {
    pictures.push_back(IsWorn(i, worn) ? cv::Mat() : assets.ColourPicture(parts.textures[i].name));
  }
  std::vector<BandSurfaces> bands(kBands.size(), {parts.materials, parts.textures});
  for (std::size_t band = 0; band < bands.size(); ++band) {
    for (const Wardrobe::Worn& one : worn) DressModel(one, band, &bands[band]);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (!IsWorn(i, worn)) DressSheet(i, pictures[i], band, &bands[band]);
    }
  }
  return bands;
}

}  // namespace aisle::sim
