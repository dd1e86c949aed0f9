#include "slam/mapping/mapping_policy.h"

namespace aisle::slam {

MappingPolicy PlainMapping(int mapping_frames) {
  return {{mapping_frames, MapKeyframe, MapKeyframe, mapping_frames, nullptr}};
}

}  // namespace aisle::slam
