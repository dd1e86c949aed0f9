aisle_tests(harness/campaign)
# valijson's own code sets off false alarms of GCC 12 where it is inlined.
set_source_files_properties(${CMAKE_SOURCE_DIR}/tests/harness/campaign/suite_schema_test.cc PROPERTIES COMPILE_OPTIONS
  "-Wno-stringop-overflow;-Wno-array-bounds;-Wno-restrict;-Wno-maybe-uninitialized")
