#include <dlfcn.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "simulator/mesh/door/read_model.h"

namespace {

using Decode = cv::Mat (*)(const cv::_InputArray&, int);
Decode decode = nullptr;

/// OpenCV's decoders bring more than a hundred libraries with them, nine tenths of what it costs to
/// start a reader, and many a model has no picture: this program is linked without.
void LoadPictureDecoder() {
  void* library = ::dlopen(AISLE_IMGCODECS, RTLD_NOW | RTLD_LOCAL);
  void* function =
      library == nullptr ? nullptr : ::dlsym(library, "_ZN2cv8imdecodeERKNS_11_InputArrayEi");
  if (function == nullptr) {
    throw std::runtime_error(fmt::format("pictures cannot be read: {}", ::dlerror()));
  }
  decode = reinterpret_cast<Decode>(function);
}

}  // namespace

/// Stands in OpenCV's place, for all that is linked to this program.
cv::Mat cv::imdecode(InputArray bytes, int flags) {
  if (decode == nullptr) ::_exit(aisle::sim::kNeedsPictures);
  return decode(bytes, flags);
}

/// Ends at once: whatever a file has done to this process, nothing of it runs on.
int main(int argc, char** argv) {
  ::_exit(aisle::sim::RunReadModel(argc, argv, LoadPictureDecoder));
}
