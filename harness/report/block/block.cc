#include "harness/report/block/block.h"

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/record/provenance.h"

namespace aisle {
namespace {

bool IsWord(const std::string& text) {
  return !text.empty() && text.find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyz"
                              "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
}

/// Where the only line that begins like this begins.
std::size_t LineOf(const std::string& page, const BlockPlace& place, const std::string& mark) {
  const std::size_t at = page.find(mark);
  const bool once = at != std::string::npos && page.find(mark, at + 1) == std::string::npos;
  if (once && (at == 0 || page[at - 1] == '\n')) return at;
  throw InputError(fmt::format(
      "{}: the line '{}' {}; expected '<!-- begin {}: FOLDERS -->' and, after it, '<!-- end {} "
      "-->', each once and at the beginning of a line",
      Printable(place.file), mark,
      at == std::string::npos ? "is missing" : (once ? "is indented" : "is there twice"),
      place.block, place.block));
}

}  // namespace

BlockPlace ParseBlockPlace(const std::string& text, const std::string& usual) {
  const std::size_t hash = text.rfind('#');
  if (hash == std::string::npos) return {.file = text, .block = usual};
  BlockPlace place{.file = text.substr(0, hash), .block = text.substr(hash + 1)};
  if (IsWord(place.block) && !place.file.empty()) return place;
  throw InputError(Printable(text) +
                   ": expected PAGE or PAGE#BLOCK, for example reports/light.md#" + usual);
}

std::string WithBlock(const std::string& page, const BlockPlace& place, const std::string& body) {
  const std::size_t begin = LineOf(page, place, fmt::format("<!-- begin {}:", place.block));
  const std::size_t end = LineOf(page, place, fmt::format("<!-- end {} -->", place.block));
  if (end < begin) {
    throw InputError(fmt::format("{}: '<!-- begin {}' must come before '<!-- end {}'",
                                 Printable(place.file), place.block, place.block));
  }
  const std::size_t first = page.find('\n', begin) + 1;  // the end's line comes after it
  std::string text = body;
  while (text.ends_with('\n')) text.pop_back();
  return page.substr(0, first) + "\n" + text + "\n\n" + page.substr(end);
}

std::string BlockFoot(const Provenance& from, const std::string& command, const std::string& when) {
  return fmt::format("`{}`; commit {}, {}, {} threads, {}.\n", command, from.commit, from.cpu,
                     from.threads, when.substr(0, when.find('T')));
}

void WriteBlock(const BlockPlace& place, const std::string& table, const std::string& command) {
  const std::string foot = BlockFoot(OwnProvenance(), command, NowIso8601());
  WriteFileAtomically(place.file, WithBlock(ReadFile(place.file), place, table + "\n" + foot));
}

}  // namespace aisle
