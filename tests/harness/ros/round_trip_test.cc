// Every message type, filled at random, comes back from its bytes as it was.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "harness/ros/cdr.h"
#include "harness/ros/drawing.h"
#include "harness/ros/geometry.h"
#include "harness/ros/sensor.h"
#include "tests/support/arbitrary.h"

namespace aisle::ros {
namespace {

/// Visits the fields of a message, as writer and reader do, and gives each any value.
struct Filler {
  template <class T>
  void operator()(const char* /*name*/, T& value) {
    Fill(&value);
  }

  template <class T>
  requires std::is_integral_v<T>
  void Fill(T* value) { *value = AnyWhole<T>(); }
  void Fill(double* value) { *value = AnyNumber(); }
  void Fill(float* value) { *value = static_cast<float>(AnyNumberIn(-1e6, 1e6)); }
  void Fill(std::string* text) { *text = AnyText(); }
  template <class T>
  void Fill(std::vector<T>* sequence) {
    sequence->resize(static_cast<std::size_t>(AnyOf(0, 4)));
    for (T& element : *sequence) Fill(&element);
  }
  template <class T, std::size_t n>
  void Fill(std::array<T, n>* array) {
    for (T& element : *array) Fill(&element);
  }
  template <Message T>
  void Fill(T* message) {
    T::Fields(*this, *message);
  }
};

/// Visits the fields of two messages of a type alike and counts those that differ.
struct Texts {
  std::vector<std::string> values;

  template <class T>
  void operator()(const char* /*name*/, const T& value) {
    Add(value);
  }
  template <class T>
  requires std::is_arithmetic_v<T>
  void Add(T value) { values.push_back(fmt::format("{}", value)); }
  void Add(const std::string& text) { values.push_back(text); }
  template <class T>
  void Add(const std::vector<T>& sequence) {
    values.push_back(fmt::format("{} of them", sequence.size()));
    for (const T& element : sequence) Add(element);
  }
  template <class T, std::size_t n>
  void Add(const std::array<T, n>& array) {
    for (const T& element : array) Add(element);
  }
  template <Message T>
  void Add(const T& message) {
    T::Fields(*this, message);
  }
};

template <Message T>
std::vector<std::string> ValuesOf(const T& message) {
  Texts texts;
  texts.Add(message);
  return texts.values;
}

template <class T>
class RoundTrip : public testing::Test {};
using Messages = testing::Types<Time, Duration, Header, ColorRGBA, String, PoseStamped,
                                PoseWithCovarianceStamped, TransformStamped, TFMessage, Odometry,
                                Path, Image, CompressedImage, CameraInfo, UVCoordinate, MeshFile,
                                Marker, MarkerArray, ImageMarker, Log>;
TYPED_TEST_SUITE(RoundTrip, Messages);

TYPED_TEST(RoundTrip, GivesEveryFieldBack) {
  EXPECT_TRUE(rc::check([] {
    TypeParam message;
    Filler().Fill(&message);
    const std::string bytes = Serialize(message);
    const auto back = Deserialize<TypeParam>(bytes);
    RC_ASSERT(ValuesOf(back) == ValuesOf(message));
    RC_ASSERT(Serialize(back) == bytes);
  }));
}

TYPED_TEST(RoundTrip, OfACutMessageIsRefused) {
  EXPECT_TRUE(rc::check([] {
    TypeParam message;
    Filler().Fill(&message);
    const std::string bytes = Serialize(message);
    const auto length = static_cast<std::size_t>(AnyOf(0, static_cast<int>(bytes.size())));
    try {
      Deserialize<TypeParam>(std::string_view(bytes).substr(0, length));
      RC_FAIL("read");
    } catch (const CdrError&) {
    }
  }));
}

TEST(RoundTripOfPoses, KeepsThePlaceAndTheTurn) {
  EXPECT_TRUE(rc::check([] {
    const Eigen::Isometry3d pose = AnyPose();
    for (const Eigen::Isometry3d& back :
         {IsometryOf(PoseOf(pose)), IsometryOf(TransformOf(pose))}) {
      RC_ASSERT(back.translation() == pose.translation());
      RC_ASSERT(back.linear().isApprox(pose.linear(), 1e-14));
    }
  }));
}

TEST(PosesOfMessages, AreFiniteAndWithinReach) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double far_m : {1e8, -1e8}) {
    EXPECT_EQ(IsometryOf(Pose{.position = {.y = far_m}}).translation().y(), far_m);
  }
  for (const double beyond_m : {1.001e8, -1.001e8, 1e200, kInfinity, -kInfinity, std::nan("")}) {
    EXPECT_THROW(IsometryOf(Pose{.position = {.x = beyond_m}}), CdrError) << beyond_m;
    EXPECT_THROW(IsometryOf(Transform{.translation = {.z = beyond_m}}), CdrError) << beyond_m;
  }
}

}  // namespace
}  // namespace aisle::ros
