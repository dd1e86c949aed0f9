#include "harness/io/zip.h"

#include <cstdint>
#include <cstring>

#include "harness/io/crc32.h"

namespace aisle {
namespace {

template <typename T>
void Put(T value, std::string* to) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);  // x86 is little endian, as ZIP is
  to->append(bytes, sizeof value);
}

constexpr std::uint16_t kVersion = 20;
constexpr std::uint16_t kDate = (1 << 5) | 1;  // 1980-01-01: the earliest, and always the same

/// What local and central header have in common, from "version needed" on.
void PutCommon(const std::string& name, const std::string& bytes, std::string* to) {
  Put<std::uint16_t>(kVersion, to);
  Put<std::uint16_t>(0, to);  // flags
  Put<std::uint16_t>(0, to);  // stored
  Put<std::uint16_t>(0, to);  // time
  Put<std::uint16_t>(kDate, to);
  Put<std::uint32_t>(Crc32(bytes), to);
  Put(static_cast<std::uint32_t>(bytes.size()), to);
  Put(static_cast<std::uint32_t>(bytes.size()), to);
  Put(static_cast<std::uint16_t>(name.size()), to);
  Put<std::uint16_t>(0, to);  // extra field
}

}  // namespace

std::string MakeZip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, bytes] : files) {
    const auto offset = static_cast<std::uint32_t>(archive.size());
    Put<std::uint32_t>(0x04034b50, &archive);
    PutCommon(name, bytes, &archive);
    archive += name + bytes;

    Put<std::uint32_t>(0x02014b50, &directory);
    Put<std::uint16_t>(kVersion, &directory);
    PutCommon(name, bytes, &directory);
    Put<std::uint16_t>(0, &directory);  // comment
    Put<std::uint16_t>(0, &directory);  // disk
    Put<std::uint16_t>(0, &directory);  // internal attributes
    Put<std::uint32_t>(0, &directory);  // external attributes
    Put<std::uint32_t>(offset, &directory);
    directory += name;
  }
  const auto start = static_cast<std::uint32_t>(archive.size());
  archive += directory;
  Put<std::uint32_t>(0x06054b50, &archive);
  Put<std::uint32_t>(0, &archive);  // disks
  Put(static_cast<std::uint16_t>(files.size()), &archive);
  Put(static_cast<std::uint16_t>(files.size()), &archive);
  Put(static_cast<std::uint32_t>(directory.size()), &archive);
  Put<std::uint32_t>(start, &archive);
  Put<std::uint16_t>(0, &archive);  // comment
  return archive;
}

std::string MakeNpy(const std::vector<double>& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(values.size()) + ",), }";
  constexpr std::size_t kBefore = 10, kAlign = 64;  // magic, version, length; data starts aligned
  while ((kBefore + header.size() + 1) % kAlign != 0) header += ' ';
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  Put(static_cast<std::uint16_t>(header.size()), &bytes);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  return bytes;
}

}  // namespace aisle
