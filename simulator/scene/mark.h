#pragma once

namespace aisle::sim {

/// Where in the scene file something stands, from 1; 0: nowhere (a default).
struct Mark {
  int line = 0;
  int column = 0;
};

}  // namespace aisle::sim
