aisle_tests(harness/cli LINKS harness_record_nights rapidcheck)
