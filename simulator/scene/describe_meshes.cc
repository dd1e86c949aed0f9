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

void DescribePersonFiles(Fields& f, PersonSpec& person) {
  CaptureSpec& capture = person.capture;
  f.Sentence({"bvh",
              "a recorded motion, a BVH file, played once from start_s on: its first frame stands "
              "at `start` and looks along heading_deg; instead of steps",
              "walk.bvh"},
             &capture.bvh.name);
  capture.bvh.mark = f.MarkOf("bvh");
  DescribeMesh(f, "a skinned model of one's own instead of `model`: .glb, or import-mesh --skinned",
               capture.mesh);
  f.Sentence({"clip", "of that model's animations the one it plays; absent: the only one", "Walk"},
             &capture.clip);
  f.Number({"stride_m", "way that one turn of that clip walks; 0: it plays by the clock", "1.4"},
           &capture.stride_m, {0, 20});
}

void DescribePropMesh(Fields& f, PropSpec& prop) {
  DescribeMesh(f, "a mesh of one's own instead of `model`: .aislemesh or .glb", prop.mesh);
  f.Choice({"label", "what such a mesh is", "furniture"}, &prop.label, kLabels);
}

}  // namespace aisle::sim
