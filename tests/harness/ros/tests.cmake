find_package(fastcdr QUIET)  # an independent decoder, where Debian's libfastcdr-dev is there
aisle_tests(harness/ros LINKS rapidcheck)
if(fastcdr_FOUND)
  target_link_libraries(harness_ros_test PRIVATE fastcdr)
  target_compile_definitions(harness_ros_test PRIVATE AISLE_FASTCDR)
endif()
