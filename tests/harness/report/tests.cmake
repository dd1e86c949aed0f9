find_package(pugixml REQUIRED)  # an independent reader of what pages and charts say
foreach(part block markup chart page picture)
  aisle_tests(harness/report/${part} LINKS harness_record_nights pugixml::pugixml)
endforeach()
aisle_tests(harness/report/paper LINKS harness_record_nights)
# Made-up nights, looked at by a browser where Debian's chromium is there.
aisle_tests(harness/report LINKS harness_record_nights)
foreach(program write_night write_month)
  add_executable(${program} ${CMAKE_SOURCE_DIR}/tests/harness/report/${program}.cc)
  target_link_libraries(${program} PRIVATE harness_report harness_record_nights)
  target_precompile_headers(${program} REUSE_FROM aisle_pch)
endforeach()
add_test(NAME harness/report_in_browser COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_SOURCE_DIR}/tests/harness/report/browser_test.py $<TARGET_FILE:write_night>)
add_test(NAME harness/month_in_browser COMMAND ${Python3_EXECUTABLE}
  ${CMAKE_SOURCE_DIR}/tests/harness/report/month_test.py $<TARGET_FILE:write_month>)
set_tests_properties(harness/report_in_browser harness/month_in_browser PROPERTIES
  SKIP_RETURN_CODE 77 TIMEOUT 600)
