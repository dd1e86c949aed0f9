aisle_tests(harness/judge LINKS harness_record_nights)
