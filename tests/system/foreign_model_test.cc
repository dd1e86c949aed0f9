// Models from elsewhere, as whoever brings his own assets meets the door they come through.
#include <gmock/gmock.h>
#include <stdlib.h>

#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class ForeignModelTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    assets_ = folder_ / "elsewhere";
    fs::create_directories(folder_);
    fs::copy(fs::path(AISLE_SOURCE_DIR) / "assets", assets_, fs::copy_options::recursive);
  }
  void TearDown() override {
    ::unsetenv("AISLE_ASSETS");
    ProgramTest::TearDown();
  }

  /// One picture of the short scene, whose person is worker_anton.
  Said Preview(const std::string& picture) const {
    return Run({"preview", scene_, "-o", (folder_ / picture).string()});
  }

  fs::path assets_;
};

TEST_F(ForeignModelTest, GivesTheSamePicture) {
  ASSERT_EQ(Preview("own.png").code, 0);
  ::setenv("AISLE_ASSETS", assets_.c_str(), 1);
  const Said said = Preview("foreign.png");
  EXPECT_EQ(said.code, 0) << said.text;
  EXPECT_EQ(ReadFile(folder_ / "foreign.png"), ReadFile(folder_ / "own.png"));
}

TEST_F(ForeignModelTest, ThatIsDamagedIsOneErrorWithThePlaceOfTheKeyThatNamesIt) {
  ::setenv("AISLE_ASSETS", assets_.c_str(), 1);
  const fs::path model = assets_ / "people/worker_anton.glb";
  fs::resize_file(model, 5000);
  const Said said = Preview("none.png");
  EXPECT_EQ(said.code, 4) << said.text;
  EXPECT_THAT(said.text, testing::HasSubstr("model of walker: " + model.string() + ": it is cut"));
  EXPECT_FALSE(fs::exists(folder_ / "none.png"));
}

}  // namespace
}  // namespace aisle
