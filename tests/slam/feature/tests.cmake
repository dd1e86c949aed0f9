aisle_tests(slam/feature LINKS opencv_imgproc)
