aisle_tests(harness/score USES harness/io LINKS rapidcheck)
