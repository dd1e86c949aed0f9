aisle_tests(simulator/shade USES simulator/foreign LINKS opencv_imgcodecs)
