aisle_tests(slam/map LINKS rapidcheck)
