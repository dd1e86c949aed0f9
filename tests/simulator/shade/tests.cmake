aisle_tests(simulator/shade USES simulator/foreign simulator/shade/reference LINKS opencv_imgcodecs)
