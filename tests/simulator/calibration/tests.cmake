aisle_tests(simulator/calibration LINKS rapidcheck)
