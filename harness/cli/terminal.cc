#include "harness/cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace aisle {

bool StdoutHasColor() {
  const char* no_color = std::getenv("NO_COLOR");
  return ::isatty(STDOUT_FILENO) != 0 && (no_color == nullptr || *no_color == '\0');
}

namespace {

std::size_t ColumnsOf(int stream) {
  if (const char* said = std::getenv("COLUMNS"); said != nullptr) {
    constexpr int kFewest = 20;  // of a real terminal
    if (const int columns = std::atoi(said); columns >= kFewest)
      return static_cast<std::size_t>(columns);
  }
  winsize size{};
  ::ioctl(stream, TIOCGWINSZ, &size);
  constexpr std::size_t kUsual = 80;
  return size.ws_col > 1 ? size.ws_col : kUsual;
}

}  // namespace

TextLook LookOfStdout() {
  return {.color = StdoutHasColor(),
          .width = ::isatty(STDOUT_FILENO) != 0 ? ColumnsOf(STDOUT_FILENO) : 0};
}

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}

void ProgressLine::Show(const std::string& text, Clock::time_point now) {
  if (!terminal_) {
    constexpr std::chrono::minutes kBetweenLines(1);
    if (!said_) said_ = now;
    if (now - *said_ < kBetweenLines) return;
    fmt::print(stderr, "{}\n", text);
    said_ = now;
    return;
  }
  fmt::print(stderr, "\r\x1b[K{}", FirstColumns(text, ColumnsOf(STDERR_FILENO) - 1));
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::Clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
}

std::string Abridged(const std::string& text, std::size_t width) {
  return text.size() <= width ? text : "…" + text.substr(text.size() - width + 1);
}

}  // namespace aisle
