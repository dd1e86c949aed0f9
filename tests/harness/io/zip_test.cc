#include "harness/io/zip.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace aisle {
namespace {

namespace fs = std::filesystem;

TEST(ZipTest, IsWhatOtherProgramsRead) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_zip_{}", ::getpid());
  fs::create_directories(folder);
  std::ofstream(folder / "a.zip", std::ios::binary)
      << MakeZip({{"x.npy", MakeNpy({1.5, -2.25, 1e300})}, {"n.json", "{\"a\": 1}"}});
  // NumPy and Python's zipfile are the readers that evo itself uses.
  const std::string check = fmt::format(
      "/usr/bin/python3 -c \"import io,json,zipfile,numpy; z = zipfile.ZipFile('{}'); "
      "assert z.testzip() is None; assert json.loads(z.read('n.json')) == dict(a=1); "
      "a = numpy.load(io.BytesIO(z.read('x.npy'))); assert a.tolist() == [1.5, -2.25, 1e300]\"",
      (folder / "a.zip").string());
  EXPECT_EQ(std::system(check.c_str()), 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace aisle
