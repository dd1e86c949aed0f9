aisle_tests(simulator/scene)
# valijson's own code sets off false alarms of GCC 12 where it is inlined.
target_compile_options(simulator_scene_test PRIVATE -Wno-stringop-overflow -Wno-array-bounds -Wno-restrict
                                                    -Wno-maybe-uninitialized)
