# Some look at the rig as well, at pictures, or at the whole detector.
aisle_tests(slam/dynamic/common LINKS TBB::tbb)
aisle_tests(slam/dynamic/paper USES slam/camera LINKS opencv_features2d)
aisle_tests(slam/dynamic/robust USES slam/dynamic)
aisle_tests(slam/dynamic LINKS opencv_imgcodecs)
