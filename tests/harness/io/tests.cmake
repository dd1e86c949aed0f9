find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs video)
aisle_tests(harness/io LINKS opencv_imgcodecs opencv_video rapidcheck)
