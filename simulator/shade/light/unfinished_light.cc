#include "simulator/shade/light/unfinished_light.h"

#include <xxhash.h>

#include "simulator/shade/light/light_cache.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

struct Piece {
  std::uint64_t first = 0, points = 0;
  std::uint64_t checksum = 0;  ///< of the light, seeded by key and first point
};

std::uint64_t Checksum(std::uint64_t key, std::uint64_t first, std::span<const float> light) {
  return XXH3_64bits_withSeed(light.data(), light.size_bytes(), key + first);
}

/// Appends the piece that comes next in the stream; false where there is none, or it is damaged.
bool ReadPiece(std::uint64_t key, std::ifstream* in, std::vector<float>* light) {
  constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 24;
  Piece piece;
  in->read(reinterpret_cast<char*>(&piece), sizeof(piece));
  if (!in->good() || piece.first != light->size() || piece.points > kMostPoints) return false;
  light->resize(piece.first + piece.points);
  const std::span<float> read = std::span(*light).subspan(piece.first);
  in->read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(read.size_bytes()));
  const bool is_whole = in->good() && Checksum(key, piece.first, read) == piece.checksum;
  if (!is_whole) light->resize(piece.first);
  return is_whole;
}

}  // namespace

UnfinishedLight::UnfinishedLight(const fs::path& folder, std::uint64_t key) : key_(key) {
  const fs::path file = UnfinishedFileOf(folder, key);
  std::streamoff whole = 0;
  if (std::ifstream in(file, std::ios::binary); in) {
    while (ReadPiece(key, &in, &begun_)) whole = in.tellg();
  }
  points_ = begun_.size();
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::exists(file, error)) fs::resize_file(file, static_cast<std::uintmax_t>(whole), error);
  if (!error) out_.open(file, std::ios::binary | std::ios::app);
}

void UnfinishedLight::Append(std::span<const float> light) {
  if (!out_.is_open()) return;
  const Piece piece{points_, light.size(), Checksum(key_, points_, light)};
  out_.write(reinterpret_cast<const char*>(&piece), sizeof(piece));
  out_.write(reinterpret_cast<const char*>(light.data()),
             static_cast<std::streamsize>(light.size_bytes()));
  out_.flush();
  points_ += light.size();
  if (!out_) out_.close();  // the disc is full: what is behind the last whole piece is not read
}

}  // namespace aisle::sim
