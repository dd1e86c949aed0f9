aisle_tests(harness/plugs USES harness/run)
