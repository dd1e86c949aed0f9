aisle_tests(slam/place LINKS opencv_imgcodecs opencv_imgproc opencv_calib3d)
