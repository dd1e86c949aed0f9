aisle_tests(harness/suite LINKS rapidcheck)
