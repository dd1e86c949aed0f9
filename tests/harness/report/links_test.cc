#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <regex>
#include <set>

#include "harness/io/file.h"
#include "harness/judge/limit.h"
#include "harness/report/report.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// What pages say of themselves, read as a browser would: percent-decoded, entities resolved.
struct ReadPage {
  std::vector<std::string> links;  ///< of href and src
  std::vector<std::string> ids;
};

std::string Decoded(const std::string& text) {
  std::string plain;
  const std::map<std::string, char> entities = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
  for (std::size_t i = 0; i < text.size();) {
    const auto entity = std::ranges::find_if(entities, [&](const auto& one) {
      return text.compare(i, one.first.size(), one.first) == 0;
    });
    if (entity != entities.end()) {
      plain += entity->second;
      i += entity->first.size();
    } else {
      plain += text[i++];
    }
  }
  return plain;
}

std::string PercentDecoded(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size();
    plain += coded ? static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)) : text[i];
    if (coded) i += 2;
  }
  return plain;
}

ReadPage Read(const fs::path& file) {
  const std::string html = ReadFile(file);
  ReadPage page;
  const std::regex link("\\s(href|src)=\"([^\"]*)\""), id("\\sid=\"([^\"]*)\"");
  for (std::sregex_iterator at(html.begin(), html.end(), link), end; at != end; ++at) {
    page.links.push_back(Decoded((*at)[2]));
  }
  for (std::sregex_iterator at(html.begin(), html.end(), id), end; at != end; ++at) {
    page.ids.push_back(Decoded((*at)[1]));
  }
  return page;
}

class Links : public testing::TestWithParam<std::size_t> {
 protected:
  void TearDown() override { fs::remove_all(folder_); }
  const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("aisle_links_{}_{}", ::getpid(), GetParam());
};

/// Every link of every page of a report leads to a file of it, and every anchor to an id of that
/// page; no id is there twice. Many scenes have pages of their own, few stand on one page.
TEST_P(Links, LeadSomewhere) {
  NightOptions options;
  options.scenes = GetParam();
  options.seeds = 2;
  options.frames = 60;
  options.pictures = true;
  options.systems = {"orbslam2", "oracle"};
  Results night = MakeNight(options, folder_);
  night.verdicts = Judge(
      night.runs,
      {{.score = "ate_rmse_m", .scene = "", .twin = "live", .system = "", .min = {}, .max = 0.02}});
  WriteReport(night, folder_);
  std::map<fs::path, ReadPage> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.path().extension() == ".html") pages[entry.path()] = Read(entry.path());
  }
  EXPECT_GE(pages.size(), GetParam() > 8 ? GetParam() : 1u);
  std::size_t followed = 0, anchors = 0;
  for (const auto& [file, page] : pages) {
    const std::set<std::string> ids(page.ids.begin(), page.ids.end());
    EXPECT_EQ(ids.size(), page.ids.size()) << file << ": an id is there twice";
    for (const std::string& link : page.links) {
      SCOPED_TRACE(file.string() + " -> " + link);
      EXPECT_FALSE(link.starts_with('/'));
      EXPECT_EQ(link.find("://"), std::string::npos) << "a report stands alone";
      const std::size_t hash = link.find('#');
      const fs::path target =
          hash == 0
              ? file
              : (file.parent_path() / PercentDecoded(link.substr(0, hash))).lexically_normal();
      EXPECT_TRUE(fs::exists(target));
      ++followed;
      if (hash == std::string::npos || !pages.contains(target)) continue;
      ++anchors;
      const auto& there = pages.at(target).ids;
      const std::string anchor = link.substr(hash + 1);
      EXPECT_TRUE(std::ranges::count(there, anchor) ||
                  std::ranges::count(there, PercentDecoded(anchor)));
    }
  }
  EXPECT_GT(followed, 20u);
  EXPECT_GT(anchors, 3u);
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, Links, testing::Values(std::size_t{2}, std::size_t{14}));

}  // namespace
}  // namespace aisle
