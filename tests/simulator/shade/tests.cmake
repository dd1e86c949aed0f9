aisle_tests(simulator/shade LINKS opencv_imgcodecs)
