#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

constexpr std::initializer_list<const char*> kLabels = {"floor", "wall",      "column",   "rack",
                                                        "goods", "luminaire", "furniture"};

void DescribeRule(Fields& f, LabelRule& rule) {
  f.Sentence(
      {"nodes", "names of nodes; * stands for anything, ? for one character", "\"Regal*\"", true},
      &rule.nodes);
  f.Choice({"label", "what they are", "rack"}, &rule.label, kLabels);
}

}  // namespace

void DescribeMesh(Fields& f, const char* help, MeshSpec& mesh) {
  f.Sentence({"mesh", help, "shelf.aislemesh"}, &mesh.name);
  mesh.mark = f.MarkOf("mesh");
}

void DescribeHallMesh(Fields& f, HallSpec& hall) {
  DescribeMesh(f,
               "one's own building instead of floor, walls and roof: .aislemesh, as aisle "
               "import-mesh makes it, or .glb; its origin is the scene's",
               hall.mesh);
  f.ListOf({"labels",
            "what the mesh's nodes are, by their names; before the table that knows floor, wall, "
            "rack and the like",
            "[{nodes: \"Regal*\", label: rack}]"},
           &hall.labels, DescribeRule);
}

void DescribePropMesh(Fields& f, PropSpec& prop) {
  DescribeMesh(f, "a mesh of one's own instead of `model`: .aislemesh or .glb", prop.mesh);
  f.Choice({"label", "what such a mesh is", "furniture"}, &prop.label, kLabels);
}

}  // namespace aisle::sim
