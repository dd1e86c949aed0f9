aisle_tests(slam/place USES slam/stereo LINKS opencv_imgcodecs opencv_imgproc opencv_calib3d)
