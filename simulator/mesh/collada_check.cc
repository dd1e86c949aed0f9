#include "simulator/mesh/collada_check.h"

#include <charconv>
#include <pugixml.hpp>

#include "simulator/mesh/import.h"

namespace aisle::sim {
namespace {

constexpr int kDeepest = 200;  ///< elements one inside another
constexpr std::size_t kMostInputs = 64;
constexpr std::size_t kLongestFace = 1000;

using Element = pugi::xml_node;

std::string_view NameOf(const Element& element) {  // without namespace prefix
  const std::string_view name = element.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class ColladaChecker {
 public:
  explicit ColladaChecker(std::string_view text) : text_(text) {}

  void Check() {
    const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
    if (!result) Fail(result.offset, fmt::format("its XML is broken: {}", result.description()));
    Walk([this](const Element& element) {
      if (const char* id = element.attribute("id").value(); *id != '\0')
        by_id_.emplace(id, element);
    });
    Walk([this](const Element& element) { CheckElement(element); });
    CheckNodes();
  }

 private:
  [[noreturn]] void Fail(std::ptrdiff_t offset, const std::string& what) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(
                                         offset, 0, static_cast<std::ptrdiff_t>(text_.size()));
    throw ImportError(fmt::format("line {}: {}", 1 + std::count(text_.begin(), end, '\n'), what));
  }
  [[noreturn]] void Fail(const Element& at, const std::string& what) const {
    Fail(at.offset_debug(), fmt::format("<{}> {}", at.name(), what));
  }

  /// Every element, outer ones first.
  template <class Visit>
  void Walk(const Visit& visit) const {
    int depth = 0;
    for (Element at = document_.first_child(); at;) {
      if (at.type() == pugi::node_element) visit(at);
      if (at.first_child()) {
        if (++depth > kDeepest) Fail(at, fmt::format("lies more than {} deep", kDeepest));
        at = at.first_child();
        continue;
      }
      while (at && !at.next_sibling()) {
        at = at.parent();
        --depth;
      }
      at = at.next_sibling();
    }
  }

  void CheckElement(const Element& element) const {
    const std::string_view name = NameOf(element);
    if (name.ends_with("_array")) CheckArray(element, name);
    if (name == "accessor") CheckAccessor(element);
    if (name == "triangles" || name == "polylist" || name == "polygons" || name == "lines" ||
        name == "linestrips" || name == "tristrips" || name == "trifans") {
      CheckFaces(element, name);
    }
    if (name == "vertex_weights") CheckWeights(element);
    if (name == "matrix" || name == "translate" || name == "rotate" || name == "scale" ||
        name == "bind_shape_matrix") {
      Numbers(element);
    }
  }

  template <class Number>
  std::vector<Number> Parsed(const Element& element) const {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::string_view words = element.text().get();
    std::vector<Number> numbers;
    for (std::size_t at = words.find_first_not_of(kBlanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(words.find_first_of(kBlanks, at), words.size());
      std::string_view word = words.substr(at, end - at);
      if (word.starts_with('+')) word.remove_prefix(1);
      Number number{};
      const auto [stop, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (failed == std::errc::result_out_of_range && std::is_floating_point_v<Number> &&
          word.find("e-") != std::string_view::npos) {
        number = 0;  // too small to matter
      } else if (failed != std::errc() || stop != word.data() + word.size() ||
                 !std::isfinite(static_cast<double>(number))) {
        Fail(element, fmt::format("has '{}' where a finite number of its kind is expected", word));
      }
      numbers.push_back(number);
      at = words.find_first_not_of(kBlanks, end);
    }
    return numbers;
  }
  std::vector<float> Numbers(const Element& element) const { return Parsed<float>(element); }

  std::size_t Whole(const Element& element, const char* attribute, std::size_t otherwise) const {
    const std::string_view word = element.attribute(attribute).value();
    if (word.empty()) return otherwise;
    std::uint32_t number = 0;
    const auto [stop, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failed != std::errc() || stop != word.data() + word.size()) {
      Fail(element, fmt::format("has {}=\"{}\", which is not an integer", attribute, word));
    }
    return number;
  }

  void Expect(const Element& at, const char* what, std::size_t is, std::size_t should) const {
    if (is == should) return;
    Fail(at, fmt::format("has {} {}, its count asks for {}", is, what, should));
  }

  void CheckArray(const Element& element, std::string_view kind) const {
    const std::size_t count = Whole(element, "count", 0);
    if (kind == "float_array") Expect(element, "numbers", Numbers(element).size(), count);
    if (kind == "int_array") Expect(element, "numbers", Parsed<int>(element).size(), count);
    if (count > text_.size()) Fail(element, fmt::format("counts {}, more than fit", count));
  }

  /// The element that "#id" under an attribute means; empty when there is none.
  Element Target(const Element& element, const char* attribute) const {
    const std::string_view url = element.attribute(attribute).value();
    const auto found = by_id_.find(std::string(url.substr(url.starts_with('#') ? 1 : 0)));
    return found == by_id_.end() ? Element() : found->second;
  }

  void CheckAccessor(const Element& accessor) const {
    const std::size_t count = Whole(accessor, "count", 0), stride = Whole(accessor, "stride", 1),
                      offset = Whole(accessor, "offset", 0);
    const Element array = Target(accessor, "source");
    if (!array) Fail(accessor, "names an array that does not exist");
    const std::size_t there = Whole(array, "count", 0);
    if (stride == 0 || offset > there || count > (there - offset) / stride) {
      Fail(accessor, fmt::format("asks for {} elements of {} from {} on; its array has {}", count,
                                 stride, offset, there));
    }
  }

  /// How many elements the source of an input has.
  std::size_t CountOf(const Element& input) const {
    Element source = Target(input, "source");
    if (NameOf(source) == "vertices") {
      source = Target(source.find_child_by_attribute("input", "semantic", "POSITION"), "source");
    }
    if (!source) Fail(input, "names a source that does not exist");
    return Whole(source.child("technique_common").child("accessor"), "count", 0);
  }

  /// For each place of a tuple of indices the smallest number of elements that it may name.
  std::vector<std::size_t> LimitsOf(const Element& holder) const {
    std::vector<std::size_t> limits;
    for (const Element& input : holder.children("input")) {
      const std::size_t offset = Whole(input, "offset", 0);
      if (offset >= kMostInputs) Fail(input, fmt::format("has offset {}", offset));
      limits.resize(std::max(limits.size(), offset + 1), SIZE_MAX);
      limits[offset] = std::min(limits[offset], CountOf(input));
    }
    return limits;
  }

  void CheckIndices(const Element& list, const std::vector<std::size_t>& limits, int least) const {
    const std::vector<int> indices = Parsed<int>(list);
    for (std::size_t i = 0; i < indices.size(); ++i) {
      const std::size_t limit = limits[i % limits.size()];
      if (indices[i] >= least && (indices[i] < 0 || static_cast<std::size_t>(indices[i]) < limit)) {
        continue;
      }
      Fail(list,
           fmt::format("names element {}, which does not exist; there are {}", indices[i], limit));
    }
  }

  /// The sum of the corners that <vcount> lists.
  std::size_t SumOfCounts(const Element& holder, std::size_t count) const {
    const std::vector<std::uint32_t> counts = Parsed<std::uint32_t>(holder.child("vcount"));
    Expect(holder, "entries in <vcount>", counts.size(), count);
    std::size_t sum = 0;
    for (const std::uint32_t one : counts) {
      if (one > kLongestFace) Fail(holder, fmt::format("has an entry of {} in <vcount>", one));
      sum += one;
    }
    return sum;
  }

  void CheckFaces(const Element& faces, std::string_view kind) const {
    const std::size_t count = Whole(faces, "count", 0);
    const std::vector<std::size_t> limits = LimitsOf(faces);
    if (limits.empty() && count > 0) Fail(faces, "has no <input>");
    if (limits.empty()) return;
    std::size_t lists = 0, indices = 0;
    for (const Element& list : faces.children("p")) {
      CheckIndices(list, limits, 0);
      indices += Parsed<int>(list).size();
      ++lists;
    }
    if (kind == "triangles") Expect(faces, "indices", indices, count * 3 * limits.size());
    if (kind == "lines") Expect(faces, "indices", indices, count * 2 * limits.size());
    if (kind == "polylist") {
      Expect(faces, "indices", indices, SumOfCounts(faces, count) * limits.size());
    } else if (kind != "triangles" && kind != "lines") {
      Expect(faces, "lists of indices", lists, count);
    }
  }

  void CheckWeights(const Element& weights) const {
    const std::vector<std::size_t> limits = LimitsOf(weights);
    if (limits.empty()) Fail(weights, "has no <input>");
    const std::size_t sum = SumOfCounts(weights, Whole(weights, "count", 0));
    Expect(weights, "indices", Parsed<int>(weights.child("v")).size(), sum * limits.size());
    CheckIndices(weights.child("v"), limits, 0);
  }

  /// No node may contain itself by way of <instance_node>.
  void CheckNodes() const {
    std::map<std::string, std::vector<std::string>> inside;
    Walk([&](const Element& element) {
      if (NameOf(element) != "instance_node") return;
      const std::string url = element.attribute("url").value();
      for (Element above = element.parent(); above; above = above.parent()) {
        if (NameOf(above) == "node")
          inside[above.attribute("id").value()].push_back(url.substr(url.starts_with('#') ? 1 : 0));
      }
    });
    std::map<std::string, int> depth;  // 0: being looked at
    for (const auto& [id, unused] : inside) DepthOf(id, inside, 0, &depth);
  }

  int DepthOf(const std::string& id, const std::map<std::string, std::vector<std::string>>& inside,
              int above, std::map<std::string, int>* depth) const {
    const auto known = depth->find(id);
    if (above > kDeepest || (known != depth->end() && known->second == 0)) {
      throw ImportError(fmt::format("node '{}' contains itself, or lies too deep", id));
    }
    if (known != depth->end()) return known->second;
    (*depth)[id] = 0;
    int deepest = 1;
    if (const auto below = inside.find(id); below != inside.end()) {
      for (const std::string& one : below->second) {
        deepest = std::max(deepest, 1 + DepthOf(one, inside, above + 1, depth));
      }
    }
    return (*depth)[id] = deepest;
  }

  std::string_view text_;
  pugi::xml_document document_;
  std::map<std::string, Element> by_id_;
};

}  // namespace

void CheckCollada(std::string_view text) { ColladaChecker(text).Check(); }

}  // namespace aisle::sim
