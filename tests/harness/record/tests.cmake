# Made-up nights, for the rooms that read records as well.
add_library(harness_record_nights STATIC ${CMAKE_SOURCE_DIR}/tests/harness/record/night.cc)
target_link_libraries(harness_record_nights PUBLIC harness_record aisle_nouns)
target_precompile_headers(harness_record_nights REUSE_FROM aisle_pch)
aisle_tests(harness/record LINKS harness_record_nights rapidcheck)
