#include "harness/bag/grey_image.h"
#include "harness/ros/cdr.h"
#include "harness/ros/drawing.h"
#include "tests/fuzz/fuzz.h"

namespace {

template <class T>
void Read(std::string_view bytes) {
  const T message = aisle::ros::Deserialize<T>(bytes);
  const std::string again = aisle::ros::Serialize(message);
  aisle::fuzz::Hold(aisle::ros::Serialize(aisle::ros::Deserialize<T>(again)) == again,
                    "what is written reads as the same");
}

}  // namespace

/// The first byte says which type the others are.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aisle;
  if (size == 0) return 0;
  const std::string_view bytes = fuzz::Text(data, size).substr(1);
  try {
    switch (data[0] % 6) {
      case 0:
        Read<ros::CameraInfo>(bytes);
        break;
      case 1:
        Read<ros::TFMessage>(bytes);
        break;
      case 2:
        Read<ros::MarkerArray>(bytes);
        break;
      case 3:
        Read<ros::Odometry>(bytes);
        break;
      case 4:
        GreyImage(ros::Deserialize<ros::Image>(bytes));
        break;
      default:
        GreyImage(ros::Deserialize<ros::CompressedImage>(bytes));
    }
    ++fuzz::taken;
  } catch (const ros::CdrError&) {
  }
  return 0;
}
