#pragma once

namespace aisle::sim {

/// Where in a scene file something stands, from 1; 0: nowhere (a default).
struct Mark {
  int line = 0;
  int column = 0;
  int file = 0;  ///< index into Scene::files: the scene's own, or one that it extends
};

}  // namespace aisle::sim
