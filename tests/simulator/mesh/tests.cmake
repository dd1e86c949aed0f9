aisle_tests(simulator/mesh)
target_compile_definitions(simulator_mesh_test PRIVATE AISLE_PYTHON="${Python3_EXECUTABLE}")
aisle_tests(simulator/mesh/door)
target_compile_definitions(simulator_mesh_door_test PRIVATE AISLE_PYTHON="${Python3_EXECUTABLE}")
add_dependencies(simulator_mesh_door_test aisle_read_model)
aisle_tests(simulator/mesh/capture USES simulator/mesh)
# A few mutants through the door in every round; the script takes more by hand.
add_executable(door_mutants ${CMAKE_SOURCE_DIR}/tests/support/door/mutants.cc)
target_link_libraries(door_mutants PRIVATE simulator_mesh_door aisle_nouns)
target_precompile_headers(door_mutants REUSE_FROM aisle_pch)
add_dependencies(door_mutants aisle_read_model)
add_test(NAME simulator/mesh/door_mutants COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_SOURCE_DIR}/tests/support/door/mutants.py $<TARGET_FILE:door_mutants> --count 25)
set_tests_properties(simulator/mesh/door_mutants PROPERTIES TIMEOUT 600)
