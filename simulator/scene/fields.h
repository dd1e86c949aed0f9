#pragma once

#include <Eigen/Core>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "simulator/scene/scene.h"

namespace aisle::sim {

/// One key of a scene file.
struct Key {
  const char* name;
  const char* help;     ///< a sentence on what it is, with its unit
  const char* example;  ///< what may stand after the colon
  bool required = false;
  const char* unless = nullptr;  ///< another key of the same map, in whose place it may be missing
};

struct Range {
  double low = -1e9, high = 1e9;

  bool Holds(double value) const { return value >= low && value <= high; }  ///< nan: never
};

/// What a scene's cameras may be, whether it says so itself or a calibration does.
inline constexpr struct CameraRanges {
  Range size_px{64, 4096}, focal_px{20, 10000}, center_px{0, 4096}, baseline_m{0.005, 5};
} kCameraRanges;

/// A description is written once, as a function that names every field of a struct, and is used
/// twice: to read a file and to write the schema. Each call leaves the value alone when the key is
/// absent, so defaults stand in the struct and nowhere else.
class Fields {
 public:
  virtual ~Fields() = default;
  using Part = std::function<void(Fields&)>;
  using Element = std::function<void(Fields&, std::size_t)>;

  virtual void Number(const Key& key, double* value, Range range) = 0;
  virtual void Integer(const Key& key, int* value, Range range) = 0;
  virtual void Flag(const Key& key, bool* value) = 0;
  /// A name: letters, digits, '_' and '-', at most 80. Names end up in reports and file names.
  virtual void Name(const Key& key, std::string* value) = 0;
  virtual void Sentence(const Key& key, std::string* value) = 0;
  /// A list of texts, at least one.
  virtual void Sentences(const Key& key, std::vector<std::string>* values) = 0;
  /// A fixed number of numbers, [x, y] for a point.
  virtual void Numbers(const Key& key, double* values, std::size_t count, Range range) = 0;
  /// A fixed number of whole numbers.
  virtual void Integers(const Key& key, int* values, std::size_t count, Range range) = 0;
  /// A list of points [x, y], and where each stands.
  virtual void Points(const Key& key, std::vector<Eigen::Vector2d>* values,
                      std::vector<Mark>* marks) = 0;
  /// A nested map.
  virtual void Group(const Key& key, const Part& part) = 0;
  /// A list of maps; `resize` is called with their number before `element` is for each.
  virtual void List(const Key& key, const std::function<void(std::size_t)>& resize,
                    const Element& element) = 0;
  /// Where the map that is being described stands.
  virtual Mark mark() const = 0;
  /// Where that key of it stands; where the map does if the key is absent.
  virtual Mark MarkOf(const char* key) const = 0;
  /// Whether the key is there.
  virtual bool Has(const char* key) const = 0;
  /// Says that these keys mean nothing where `other` is absent: a file with such a one is mistaken.
  /// The schema does not know, as a file may have the other from the one it extends.
  virtual void OnlyWith(const char* /*other*/, std::initializer_list<const char*> /*keys*/) {}

  void Point(const Key& key, Eigen::Vector2d* value, Range range = {-1000, 1000}) {
    Numbers(key, value->data(), 2, range);
  }
  /// An angle: degrees in the file, radians in the struct.
  void Degrees(const Key& key, double* radians, Range range = {-360, 360});
  void OptionalNumber(const Key& key, std::optional<double>* value, Range range);
  /// Those of the keys that are there.
  std::vector<GivenKey> Given(std::initializer_list<const char*> keys) const;
  void OptionalPoint(const Key& key, std::optional<Eigen::Vector2d>* value);

  template <class Enum>
  void Choice(const Key& key, Enum* value, std::initializer_list<const char*> names) {
    int index = static_cast<int>(*value);
    ChoiceIndex(key, &index, names);
    *value = static_cast<Enum>(index);
  }
  template <class Item>
  void ListOf(const Key& key, std::vector<Item>* items, void (*describe)(Fields&, Item&)) {
    List(
        key, [&](std::size_t count) { items->resize(count); },
        [&](Fields& fields, std::size_t i) { describe(fields, (*items)[i]); });
  }

 protected:
  virtual void ChoiceIndex(const Key& key, int* index,
                           std::initializer_list<const char*> names) = 0;
};

/// Kinds of goods, in the order of GoodsKind.
inline constexpr std::initializer_list<const char*> kGoodsNames = {
    "mixed", "cartons", "drums", "totes", "wrapped", "identical", "nothing"};

/// Names every key of a scene's `drive`.
void DescribeDrive(Fields& fields, DriveSpec& drive);

/// Names every key of what a hall's file may hold, `about` left out.
void DescribePremises(Fields& fields, Premises& premises);

/// Names every key of one of a scene's `mechanisms`.
void DescribeMechanism(Fields& fields, MechanismSpec& mechanism);

/// Names every key of one of a scene's `beams`.
void DescribeBeam(Fields& fields, BeamSpec& beam);

/// Names every key of a scene's `crowd`.
void DescribeCrowd(Fields& fields, CrowdSpec& crowd);

/// A key that names a mesh of the user's own; the keys of a hall, a person and a prop with one.
void DescribeMesh(Fields& fields, const char* help, MeshSpec& mesh);
void DescribeHallMesh(Fields& fields, HallSpec& hall);
void DescribePersonFiles(Fields& fields, PersonSpec& person);
void DescribePropMesh(Fields& fields, PropSpec& prop);

/// Names every key of a scene file, with ranges and examples.
void Describe(Fields& fields, Scene& scene);

}  // namespace aisle::sim
