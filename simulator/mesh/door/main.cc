#include <unistd.h>

#include "simulator/mesh/door/read_model.h"

/// Ends at once: whatever a file has done to this process, nothing of it runs on.
int main(int argc, char** argv) { ::_exit(aisle::sim::RunReadModel(argc, argv)); }
