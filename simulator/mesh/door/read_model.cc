#include "simulator/mesh/door/read_model.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <opencv2/core/utility.hpp>
#include <span>
#include <system_error>

#include "simulator/common/own_files.h"
#include "simulator/mesh/door/model_bytes.h"
#include "simulator/mesh/door/reading_process.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;

constexpr int kRead = 0, kNotAModel = 4, kNotAble = 3;

/// What the reader is told, one argument each, in this order.
struct Request {
  fs::path file;
  ImportOptions options;
  ReadingLimits limits;
  bool pictures = false;  ///< the model has some
};

std::vector<std::string> ArgumentsOf(const Request& request) {
  const ImportOptions& options = request.options;
  return {request.file.string(),
          options.root.string(),
          std::to_string(static_cast<int>(options.frame)),
          std::to_string(static_cast<int>(options.band)),
          std::to_string(static_cast<int>(options.colour)),
          fmt::format("{}", options.unit_m),
          std::to_string(static_cast<int>(options.up)),
          std::to_string(static_cast<int>(options.must_state)),
          std::to_string(static_cast<int>(options.one_file)),
          std::to_string(options.max_triangles),
          std::to_string(options.max_texture_px),
          std::to_string(options.max_file_bytes),
          fmt::format("{}", options.max_reach_m),
          std::to_string(request.limits.memory_bytes),
          fmt::format("{}", request.limits.time_s),
          std::to_string(static_cast<int>(request.pictures))};
}

template <class Number>
Number NumberIn(const char* text) {
  Number number{};
  const char* end = text + std::strlen(text);
  if (const auto [at, failed] = std::from_chars(text, end, number);
      failed != std::errc() || at != end) {
    throw std::runtime_error(fmt::format("'{}' is not a number that is expected here", text));
  }
  return number;
}

Request ParseRequest(std::span<const char* const> arguments) {
  Request request;
  if (arguments.size() != ArgumentsOf(request).size()) {
    throw std::runtime_error("this program is started by aisle, to read models");
  }
  request.file = arguments[0];
  request.options.root = arguments[1];
  request.options.frame = static_cast<ModelFrame>(NumberIn<int>(arguments[2]));
  request.options.band = static_cast<Band>(NumberIn<int>(arguments[3]));
  request.options.colour = NumberIn<int>(arguments[4]) != 0;
  request.options.unit_m = NumberIn<float>(arguments[5]);
  request.options.up = static_cast<UpAxis>(NumberIn<int>(arguments[6]));
  request.options.must_state = NumberIn<int>(arguments[7]) != 0;
  request.options.one_file = NumberIn<int>(arguments[8]) != 0;
  request.options.max_triangles = NumberIn<std::size_t>(arguments[9]);
  request.options.max_texture_px = NumberIn<int>(arguments[10]);
  request.options.max_file_bytes = NumberIn<std::size_t>(arguments[11]);
  request.options.max_reach_m = NumberIn<float>(arguments[12]);
  request.limits.memory_bytes = NumberIn<std::size_t>(arguments[13]);
  request.limits.time_s = NumberIn<double>(arguments[14]);
  request.pictures = NumberIn<int>(arguments[15]) != 0;
  return request;
}

bool WriteAll(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    bytes.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return true;
}

/// The first line, without what a terminal would obey.
std::string OneLine(std::string text) {
  text = text.substr(0, text.find('\n'));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

/// The reader's error as this file's: it says "file: what" itself, and is believed no more of it
/// than that it is text.
std::string Complaint(const fs::path& file, const std::string& text) {
  const std::string line = OneLine(text), place = file.string() + ": ";
  return line.starts_with(place) ? line : place + line;
}

/// Why there is no model, of a reading that did not end well by its own account.
std::string WhyEnded(const Reading& reading, const ModelDoor& door) {
  switch (reading.end) {
    case Reading::End::kTooLong:
      return fmt::format("it is not read after {:g} s; save it anew, or simplify it",
                         door.limits.time_s);
    case Reading::End::kTooMuch:
      return fmt::format("it holds more than {} bytes; simplify it", door.most_bytes);
    case Reading::End::kSignalled:
      return fmt::format(
          "its reader did not survive it (signal {}, {}): the file is damaged, or made to do harm; "
          "export it again",
          reading.code, ::strsignal(reading.code));
    case Reading::End::kExited:
      break;
  }
  return {};
}

/// What a reader makes of it: one without pictures, which starts ten times as soon, and where it
/// meets one the other.
Reading Read(Request* request, const ModelDoor& door) {
  const fs::path program = door.program.empty() ? ReaderProgram() : door.program;
  const auto run = [&] {
    return RunReader(program, ArgumentsOf(*request), door.limits, door.most_bytes);
  };
  Reading reading = run();
  if (reading.end != Reading::End::kExited || reading.code != kNeedsPictures) return reading;
  request->pictures = true;
  return run();
}

[[noreturn]] void FailAsItEnded(const fs::path& file, const Reading& reading,
                                const ModelDoor& door) {
  if (const std::string why = WhyEnded(reading, door); !why.empty()) {
    throw ImportError(fmt::format("{}: {}", file.string(), why));
  }
  if (reading.code == kNotAModel) throw ImportError(Complaint(file, reading.complaint));
  throw std::system_error(std::make_error_code(std::errc::protocol_error),
                          fmt::format("{}: its reader ended with exit code {}: {}", file.string(),
                                      reading.code, OneLine(reading.complaint)));
}

}  // namespace

fs::path ReaderProgram() {
  constexpr const char* kName = "aisle-read-model";
  const char* given = std::getenv("AISLE_READ_MODEL");
  if (given != nullptr && *given != '\0') return given;
  const fs::path own = FindOwnHelper(OwnFile(), kName, fs::path("simulator") / kName);
  return own.empty() ? fs::path(AISLE_LIBEXEC) / kName : own;  // a program of others: as installed
}

Model ReadModel(const fs::path& file, const ImportOptions& given, const ModelDoor& door) {
  Request request{file, given, door.limits};
  if (request.options.root.empty()) request.options.root = fs::absolute(file).parent_path();
  const Reading reading = Read(&request, door);
  if (reading.end != Reading::End::kExited || reading.code != kRead) {
    FailAsItEnded(file, reading, door);
  }
  try {
    return DecodeModel(reading.bytes, request.options);
  } catch (const ImportError& error) {
    throw ImportError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

namespace {

/// The file's bytes, or one ImportError: within the limits that are set for a file, memory that is
/// not there is too much of it.
std::string ReadHere(const Request& request) {
  const ImportError too_much(request.file.string() + ": it asks for more memory than it may have");
  try {
    return EncodeModel(ImportModel(request.file, request.options));
  } catch (const std::bad_alloc&) {
    throw too_much;
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::not_enough_memory) throw;
    throw too_much;
  }
}

}  // namespace

int RunReadModel(int argc, const char* const* argv, void (*load_pictures)()) {
  std::string bytes;
  try {
    const Request request =
        ParseRequest(std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    if (request.pictures) load_pictures();
    cv::setNumThreads(1);  // it may start none
    ConfineThisProcess(request.options.root, request.limits);
    bytes = ReadHere(request);
  } catch (const ImportError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kNotAModel;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kNotAble;
  }
  return WriteAll(STDOUT_FILENO, bytes) ? kRead : kNotAble;
}

}  // namespace aisle::sim
