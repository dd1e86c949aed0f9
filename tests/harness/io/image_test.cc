#include "harness/io/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/io/crc32.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/io/png_size.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class FloatImageTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "temp");
    ::setenv("OPENCV_TEMP_PATH", (folder_ / "temp").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("OPENCV_TEMP_PATH");
    fs::remove_all(folder_);
  }
  fs::path Write(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder_ / name, text, Durability::kSurvivesProcessLoss);
    return folder_ / name;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_image_{}", ::getpid());
};

TEST_F(FloatImageTest, GivesTheRowsOfAPortableFloatMapFromTheTop) {
  // Bottom row first; red, green, blue.
  const float values[] = {1, 2, 3, 4, 5, 6};
  std::string text = "PF\n1 2\n-1.0\n";
  text.append(reinterpret_cast<const char*>(values), sizeof(values));
  const cv::Mat3f image = ReadLinearImage(Write("image.pfm", text));
  ASSERT_EQ(image.size(), cv::Size(1, 2));
  EXPECT_EQ(image(0, 0), cv::Vec3f(6, 5, 4));
  EXPECT_EQ(image(1, 0), cv::Vec3f(3, 2, 1));
}

TEST_F(FloatImageTest, IsWrittenAsOpenCvReadsAndWritesIt) {
  cv::Mat1f grey(3, 5);
  cv::Mat3f colours(4, 3);
  cv::RNG rng(5);
  rng.fill(grey, cv::RNG::NORMAL, 0, 100);
  rng.fill(colours, cv::RNG::NORMAL, 0, 100);
  for (const cv::Mat& image : {cv::Mat(grey), cv::Mat(grey.colRange(1, 4)), cv::Mat(colours)}) {
    const fs::path ours = folder_ / "ours.pfm", theirs = folder_ / "theirs.pfm";
    WriteImage(ours, image);
    cv::imwrite(theirs.string(), image);
    EXPECT_EQ(ReadFile(ours), ReadFile(theirs));
    const cv::Mat back = cv::imread(ours.string(), cv::IMREAD_UNCHANGED);
    EXPECT_EQ(cv::norm(back, image, cv::NORM_INF), 0);
  }
  WriteVectorPfm(folder_ / "vectors.pfm", colours);
  cv::Mat3f first_last;
  cv::cvtColor(ReadLinearImage(folder_ / "vectors.pfm"), first_last, cv::COLOR_BGR2RGB);
  EXPECT_EQ(cv::norm(first_last, colours, cv::NORM_INF), 0);
  EXPECT_TRUE(fs::is_empty(folder_ / "temp"));
}

TEST_F(FloatImageTest, LeavesNothingBehindWhereItIsBroken) {
  for (const char* text : {"PF\n 2\n-1.0\n2 2\n", "Pf\n2 0\n0\n", "PF\n2 2\n-1.0\nshort", "exr"}) {
    const fs::path file = Write("broken.pfm", text);
    EXPECT_THROW(ReadLinearImage(file), InputError) << text;
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "temp"));
}

/// A header of an image that would fill memory with what a few bytes of zeros compress to.
TEST_F(FloatImageTest, RefusesAPngOfAbsurdlyManyPixelsBeforeItIsDecoded) {
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0\x08\x06\0\0\0", 29);
  png += std::string(16, '\0');
  for (const auto read : {+[](const fs::path& file) { ReadMaskPng(file); },
                          +[](const fs::path& file) { ReadGreyPng(file); }}) {
    try {
      read(Write("bomb.png", png));
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("has 16384x16384 pixels; at most 67108864"));
    }
  }
}

std::string BigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::string Chunk(const std::string& name, const std::string& data) {
  return BigEndian(static_cast<std::uint32_t>(data.size())) + name + data +
         BigEndian(Crc32(name + data));
}

/// Where the header has to be stands another chunk, whose bytes are no size.
TEST_F(FloatImageTest, APngThatDoesNotOpenWithItsHeaderIsNone) {
  const std::string png =
      "\x89PNG\r\n\x1a\n" + Chunk("gAMA", BigEndian(45455)) +
      Chunk("IHDR", BigEndian(4) + BigEndian(1) + std::string("\x8\0\0\0\0", 5));
  EXPECT_FALSE(SizeOfPng(png));
  try {
    ReadGreyPng(Write("late.png", png));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::EndsWith("late.png: not a PNG image"));
  }
}

/// A row of four pixels of so many bits; zlib's stream holds it as it is.
std::string IndexedPng(char bits, const std::string& packed_row, const std::string& palette,
                       const std::string& between = "") {
  const std::string row = std::string(1, '\0') + packed_row;  // not filtered
  const auto size = static_cast<char>(row.size());
  std::uint32_t a = 1, b = 0;
  for (const char byte : row) {
    a = (a + static_cast<unsigned char>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const std::string stream = std::string("\x78\x01\x01", 3) + size + '\0' +
                             static_cast<char>(~size) + '\xff' + row + BigEndian(b << 16 | a);
  return "\x89PNG\r\n\x1a\n" +
         Chunk("IHDR", BigEndian(4) + BigEndian(1) + bits + std::string("\3\0\0\0", 4)) +
         Chunk("PLTE", palette) + between + Chunk("IDAT", stream) + Chunk("IEND", "");
}

/// Decoders take what the palette has no colour for as black.
TEST_F(FloatImageTest, AnIndexBeyondThePaletteIsNoBlack) {
  const std::string three("\0\0\0\x80\0\0\0\x80\0", 9);
  const std::string opaque = Chunk("tRNS", "\xff");
  for (const std::string& between : {std::string(), opaque}) {
    const cv::Mat1b mask =
        ReadMaskPng(Write("good.png", IndexedPng(8, std::string("\0\1\2\0", 4), three, between)));
    EXPECT_EQ(cv::Vec4b(mask(0, 0), mask(0, 1), mask(0, 2), mask(0, 3)), cv::Vec4b(0, 255, 255, 0));
    for (const auto read : {+[](const fs::path& file) { ReadMaskPng(file); },
                            +[](const fs::path& file) { ReadGreyPng(file); }}) {
      for (const auto& [bits, row] : {std::pair(char{8}, std::string("\0\1\3\0", 4)),
                                      std::pair(char{2}, std::string("\x1c"))}) {
        try {
          read(Write("bad.png", IndexedPng(bits, row, three, between)));
          ADD_FAILURE() << int{bits};
        } catch (const InputError& error) {
          EXPECT_THAT(error.what(), testing::HasSubstr("bad.png: the pixel (2, 0) has the index 3, "
                                                       "but the palette has only 3 entries"));
        }
      }
    }
  }
}

TEST_F(FloatImageTest, SaysWhatKeepsItFromTheFile) {
  EXPECT_THROW(ReadLinearImage(folder_ / "absent.pfm"), InputError);
  EXPECT_THROW(ReadLinearImage(Write("image.png", "PF\n1 1\n-1.0\n0000")), InputError);
}

}  // namespace
}  // namespace aisle
