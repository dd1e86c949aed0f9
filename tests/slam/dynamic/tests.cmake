# The room's tests read pictures and look at slam/camera's rig as well.
aisle_tests(slam/dynamic USES slam/camera LINKS opencv_imgcodecs opencv_features2d)
