aisle_tests(harness/bag LINKS opencv_imgcodecs opencv_imgproc rapidcheck)
