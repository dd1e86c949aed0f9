#include "simulator/scene/fields.h"

namespace aisle::sim {
namespace {

constexpr std::initializer_list<const char*> kLabels = {"floor", "wall",      "column",   "rack",
                                                        "goods", "luminaire", "furniture"};

void DescribeRule(Fields& f, LabelRule& rule) {
  f.Sentence(
      {"nodes", "pattern of node names; * matches anything, ? one character", "\"Regal*\"", true},
      &rule.nodes);
  f.Choice({"label", "label of these nodes", "rack"}, &rule.label, kLabels);
}

}  // namespace

void DescribeMesh(Fields& f, const char* help, MeshSpec& mesh) {
  f.Sentence({"mesh", help, "shelf.aislemesh"}, &mesh.name);
  mesh.mark = f.MarkOf("mesh");
}

void DescribeHallMesh(Fields& f, HallSpec& hall) {
  DescribeMesh(f,
               "your own building instead of floor, walls and roof: .aislemesh, as aisle "
               "import-mesh makes it, or .glb; its origin is the scene's",
               hall.mesh);
  f.ListOf({"labels",
            "labels of the mesh's nodes by name, tried before the built-in table of floor, wall, "
            "rack and the like",
            "[{nodes: \"Regal*\", label: rack}]"},
           &hall.labels, DescribeRule);
}

void DescribePersonFiles(Fields& f, PersonSpec& person) {
  CaptureSpec& capture = person.capture;
  f.Sentence({"bvh",
              "recorded motion, a BVH file, played once from start_s on; its first frame stands at "
              "`start` and faces heading_deg; instead of steps",
              "walk.bvh"},
             &capture.bvh.name);
  capture.bvh.mark = f.MarkOf("bvh");
  DescribeMesh(f, "your own skinned model instead of `model`: .glb, or import-mesh --skinned",
               capture.mesh);
  f.Sentence({"clip", "animation of the mesh to play; absent: the only one", "Walk"},
             &capture.clip);
  f.Number(
      {"stride_m", "distance that one cycle of the clip walks; 0: it plays by the clock", "1.4"},
      &capture.stride_m, {0, 20});
  f.OnlyWith("mesh", {"clip", "stride_m"});
}

void DescribePropMesh(Fields& f, PropSpec& prop) {
  DescribeMesh(f,
               "your own mesh instead of `model`: .aislemesh or .glb; whether routes keep clear of "
               "it is not checked",
               prop.mesh);
  f.Choice({"label", "label of the mesh", "furniture"}, &prop.label, kLabels);
}

}  // namespace aisle::sim
