aisle_tests(slam/camera LINKS opencv_calib3d)
