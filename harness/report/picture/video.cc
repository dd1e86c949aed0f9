#include "harness/report/picture/video.h"

#include <csignal>
#include <cstdlib>
#include <system_error>

namespace aisle {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

Video::Video(std::filesystem::path file, double rate_hz)
    : file_(std::move(file)),
      aside_(file_.parent_path() / fmt::format(".{}.tmp.mp4", file_.filename().string())),
      rate_hz_(rate_hz) {}

Video::~Video() {
  if (pipe_ != nullptr) ::pclose(pipe_);
}

bool Video::Available() {
  static const bool available = std::system("command -v ffmpeg >/dev/null 2>&1") == 0;
  return available;
}

void Video::Add(const cv::Mat3b& picture) {
  if (failed_) return;
  if (pipe_ == nullptr) {
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that dies must not take the run with it
    size_ = picture.size();
    const std::string command = fmt::format(
        "ffmpeg -y -loglevel quiet -f rawvideo -pix_fmt bgr24 -s {}x{} -r {:g} -i - -an -threads 1 "
        "-c:v libx264 -preset superfast -crf 28 -pix_fmt yuv420p -movflags +faststart {} "
        ">/dev/null 2>&1",
        size_.width, size_.height, rate_hz_, Quoted(aside_.string()));
    pipe_ = ::popen(command.c_str(), "w");
  }
  const cv::Mat3b whole = picture.isContinuous() ? picture : picture.clone();
  const std::size_t bytes = whole.total() * whole.elemSize();
  failed_ = pipe_ == nullptr || picture.size() != size_ ||
            std::fwrite(whole.data, 1, bytes, pipe_) != bytes;
}

bool Video::Finish() {
  if (pipe_ == nullptr) return false;
  failed_ = ::pclose(pipe_) != 0 || failed_;
  pipe_ = nullptr;
  std::error_code error;
  if (!failed_) std::filesystem::rename(aside_, file_, error);
  if (failed_ || error) std::filesystem::remove(aside_, error);
  return !failed_ && !error;
}

}  // namespace aisle
