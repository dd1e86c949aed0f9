aisle_tests(simulator/mesh)
target_compile_definitions(simulator_mesh_test PRIVATE AISLE_PYTHON="${Python3_EXECUTABLE}")
