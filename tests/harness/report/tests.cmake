foreach(part markup chart page picture)
  aisle_tests(harness/report/${part})
endforeach()
aisle_tests(harness/report/paper LINKS harness_record_nights)
# Made-up nights, looked at by a browser where Debian's chromium is there.
aisle_tests(harness/report LINKS harness_record_nights)
add_executable(write_night ${CMAKE_SOURCE_DIR}/tests/harness/report/write_night.cc)
target_link_libraries(write_night PRIVATE harness_report harness_record_nights)
target_precompile_headers(write_night REUSE_FROM aisle_pch)
add_test(NAME harness/report_in_browser COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_SOURCE_DIR}/tests/harness/report/browser_test.py $<TARGET_FILE:write_night>)
set_tests_properties(harness/report_in_browser PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
