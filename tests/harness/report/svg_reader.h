#pragma once

#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

namespace aisle {

/// A reader of charts that knows SVG and nothing of how ours are written: well-formed XML, shares
/// of the width, relative and absolute path commands.
class SvgReader {
 public:
  struct Path {
    std::string css, name;
    std::vector<std::pair<double, double>> points;
  };

  explicit SvgReader(std::string markup) {
    constexpr std::string_view kFlag = " data-bare/";  // of HTML, which XML wants a value of
    for (std::size_t at; (at = markup.find(kFlag)) != std::string::npos;) {
      markup.replace(at, kFlag.size(), " data-bare=\"\"/");
    }
    const auto parsed = document_.load_string(("<all>" + markup + "</all>").c_str());
    EXPECT_TRUE(parsed) << parsed.description() << " at " << parsed.offset;
  }

  std::vector<pugi::xml_node> All(const char* element) const {
    std::vector<pugi::xml_node> nodes;
    for (const pugi::xpath_node& found :
         document_.select_nodes(fmt::format("//{}", element).c_str())) {
      nodes.push_back(found.node());
    }
    return nodes;
  }
  std::vector<pugi::xml_node> All(const char* element, const std::string& css) const {
    std::vector<pugi::xml_node> nodes = All(element);
    std::erase_if(nodes,
                  [&](const pugi::xml_node& n) { return n.attribute("class").value() != css; });
    return nodes;
  }
  /// Curves of that class, in the drawing's coordinates; those of grids and markers left out.
  std::vector<Path> Paths(const std::string& css_starts_with) const {
    std::vector<Path> paths;
    for (const pugi::xml_node& node : All("path")) {
      const std::string css = node.attribute("class").value();
      if (!css.starts_with(css_starts_with)) continue;
      const double scale =
          std::string(node.attribute("transform").value()) == "scale(.5)" ? 0.5 : 1;
      paths.push_back(
          {css, node.attribute("data-name").value(), PointsOf(node.attribute("d").value(), scale)});
    }
    return paths;
  }
  /// A place across: "12.5%" of `whole`, or a plain number.
  static double Across(const pugi::xml_attribute& attribute, double whole = 1000) {
    const std::string text = attribute.value();
    const double number = std::stod(text);
    return text.ends_with('%') ? number * whole / 100 : number;
  }

 private:
  static std::vector<std::pair<double, double>> PointsOf(const std::string& data, double scale) {
    std::vector<std::pair<double, double>> points;
    double x = 0, y = 0;
    char command = 0;
    const char* at = data.c_str();
    const auto number = [&] {
      char* end = nullptr;
      const double value = std::strtod(at, &end);
      EXPECT_NE(at, end) << data;
      at = end;
      return value;
    };
    while (*at != 0) {
      if (*at == ' ' || *at == ',') {
        ++at;
        continue;
      }
      if (std::isalpha(static_cast<unsigned char>(*at))) command = *at++;
      if (command == 'z') continue;
      if (command == 'M') {
        x = number(), y = number();
      } else if (command == 'l') {
        x += number(), y += number();
      } else if (command == 'V') {
        y = number();
      } else if (command == 'H') {
        x = number();
      } else {
        ADD_FAILURE() << "a command this reader does not know: " << data;
        return points;
      }
      points.emplace_back(scale * x, scale * y);
    }
    return points;
  }

  pugi::xml_document document_;
};

}  // namespace aisle
