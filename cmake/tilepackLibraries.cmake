# Libraries whose CMake packages in Debian 12 ask for more than they need, or that have none: OpenImageIO (its
# package wants its command line tools) with Imath, OpenCV's core and imgproc (all of OpenCV), Highway. Read by
# tilepack's build and, installed, by find_package(tilepack).
foreach(library OpenImageIO OpenImageIO_Util Imath opencv_core opencv_imgproc hwy)
  if(NOT TARGET tilepack::${library})
    find_library(TILEPACK_${library}_FILE NAMES ${library} ${library}-3_1)
    mark_as_advanced(TILEPACK_${library}_FILE)
    if(NOT TILEPACK_${library}_FILE)
      message(FATAL_ERROR "tilepack needs lib${library}, which is not here")
    endif()
    add_library(tilepack::${library} UNKNOWN IMPORTED)
    set_target_properties(tilepack::${library} PROPERTIES IMPORTED_LOCATION "${TILEPACK_${library}_FILE}")
  endif()
endforeach()
