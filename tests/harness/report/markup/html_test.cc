#include "harness/report/markup/html.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <random>

namespace aisle {
namespace {

const std::string kReplaced = "\xEF\xBF\xBD";

TEST(Escape, MarkupAndBrokenBytesAreHarmless) {
  EXPECT_EQ(Escape("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;");
  EXPECT_EQ(Escape("\xff\x01ü"), kReplaced + kReplaced + "ü");
  EXPECT_EQ(EscapeUrl("a b/<c>\n"), "a%20b/%3Cc%3E%0A");
}

TEST(EscapeUrl, TheDirectoryOfASpecIdSurvives) {
  EXPECT_EQ(EscapeUrl("runs/tests/hall/live/plain/seed_1.png"),
            "runs/tests/hall/live/plain/seed_1.png");
  EXPECT_EQ(EscapeUrl("a b#c?d\"e"), "a%20b%23c%3Fd%22e");
}

std::string Unescape(const std::string& url) {
  std::string path;
  for (std::size_t i = 0; i < url.size(); ++i) {
    if (url[i] == '%') {
      path += static_cast<char>(std::stoi(url.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      path += url[i];
    }
  }
  return path;
}

std::string RandomBytes(std::mt19937* random, std::size_t size) {
  std::string bytes;
  while (bytes.size() < size) {
    // Markup and bytes of multi-byte characters more often than chance has them.
    constexpr std::string_view kAwkward = "<>&\"'\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80\xED\xA0\xC0";
    bytes += (*random)() % 2 ? kAwkward[(*random)() % kAwkward.size()]
                             : static_cast<char>((*random)() % 256);
  }
  return bytes;
}

TEST(EscapeUrl, IsReadBackAsThePathOfAnyBytes) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const std::string path = RandomBytes(&random, static_cast<std::size_t>(i % 40));
    const std::string url = EscapeUrl(path);
    EXPECT_EQ(Unescape(url), path);
    EXPECT_EQ(url.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                    "/.-_%"),
              std::string::npos);
  }
}

/// The Unicode standard's table 3-7 of well-formed sequences, written out; what is none is replaced
/// byte by byte, and so are control bytes.
std::string WellFormed(const std::string& text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto in = [](unsigned value, unsigned low, unsigned high) {
    return low <= value && value <= high;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const unsigned a = byte(i), b = byte(i + 1), c = byte(i + 2), d = byte(i + 3);
    const bool tail = in(c, 0x80, 0xBF);
    std::size_t length = 0;
    if (a < 0x80) {
      length = 1;
    } else if (in(a, 0xC2, 0xDF) && in(b, 0x80, 0xBF)) {
      length = 2;
    } else if ((a == 0xE0 && in(b, 0xA0, 0xBF) && tail) ||
               ((in(a, 0xE1, 0xEC) || in(a, 0xEE, 0xEF)) && in(b, 0x80, 0xBF) && tail) ||
               (a == 0xED && in(b, 0x80, 0x9F) && tail)) {
      length = 3;
    } else if (((a == 0xF0 && in(b, 0x90, 0xBF)) || (in(a, 0xF1, 0xF3) && in(b, 0x80, 0xBF)) ||
                (a == 0xF4 && in(b, 0x80, 0x8F))) &&
               tail && in(d, 0x80, 0xBF)) {
      length = 4;
    }
    const bool control = length == 1 && (a < 0x20 || a == 0x7F) && a != '\n' && a != '\t';
    result += length == 0 || control ? kReplaced : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

/// A reader of XML gets back the very text, as an element's and as an attribute's: no name can
/// begin markup, end a quote or break the encoding.
TEST(Escape, AnyBytesAreReadBackAsTextAndNothingElse) {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    const std::string text = RandomBytes(&random, static_cast<std::size_t>(i % 30));
    const std::string escaped = Escape(text);
    EXPECT_EQ(escaped.find_first_of("<>\"'"), std::string::npos);
    pugi::xml_document document;
    const std::string page =
        "<p title=\"" + escaped + "\" class='" + escaped + "'>" + escaped + "</p>";
    ASSERT_TRUE(document.load_string(page.c_str(), pugi::parse_ws_pcdata | pugi::parse_escapes));
    const pugi::xml_node p = document.child("p");
    const std::string expected = WellFormed(text);
    EXPECT_EQ(p.child_value(), expected);
    EXPECT_EQ(p.attribute("title").value(), expected);
    EXPECT_EQ(p.attribute("class").value(), expected);
  }
}

TEST(Escape, OverlongSurrogateAndTooLargeSequencesAreNoCharacters) {
  EXPECT_EQ(Escape("\xC0\xBC"), kReplaced + kReplaced) << "an overlong <";
  EXPECT_EQ(Escape("\xE0\x80\xBC"), kReplaced + kReplaced + kReplaced);
  EXPECT_EQ(Escape("\xED\xA0\x80"), kReplaced + kReplaced + kReplaced) << "half a surrogate pair";
  EXPECT_EQ(Escape("\xF4\x90\x80\x80"), kReplaced + kReplaced + kReplaced + kReplaced)
      << "beyond U+10FFFF";
  EXPECT_EQ(Escape("\xF4\x8F\xBF\xBF"), "\xF4\x8F\xBF\xBF") << "U+10FFFF itself";
}

}  // namespace
}  // namespace aisle
