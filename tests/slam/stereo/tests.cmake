aisle_tests(slam/stereo)
# Its own matcher beside the library's, on rendered views.
aisle_tests(slam/stereo/dense USES slam/camera slam/dynamic/paper)
