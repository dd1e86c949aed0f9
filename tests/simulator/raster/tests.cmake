aisle_tests(simulator/raster USES simulator/truth)
