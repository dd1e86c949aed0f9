aisle_tests(simulator/truth USES simulator/shade/pass)
