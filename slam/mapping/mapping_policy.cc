#include "slam/mapping/mapping_policy.h"

namespace aisle::slam {

MappingPolicy PlainMapping(int mapping_frames) {
  const MappingStep::Work work = [](Map map, KeyframeId newest, const MappingTools& tools) {
    return MapKeyframe(std::move(map), newest, tools.vocabulary, tools.index, tools.camera,
                       tools.options, tools.loop);
  };
  return {{mapping_frames, work, work, mapping_frames, nullptr}};
}

}  // namespace aisle::slam
