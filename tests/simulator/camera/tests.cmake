find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs calib3d)
aisle_tests(simulator/camera LINKS opencv_calib3d)
