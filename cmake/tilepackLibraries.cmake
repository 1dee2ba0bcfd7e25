# Libraries without a CMake package of their own in Debian 12: OpenCV's core and imgproc (the package there asks
# for all of OpenCV) and Highway. Read by tilepack's build and, installed, by find_package(tilepack).
foreach(library opencv_core opencv_imgproc hwy)
  if(NOT TARGET tilepack::${library})
    find_library(TILEPACK_${library}_FILE ${library})
    mark_as_advanced(TILEPACK_${library}_FILE)
    if(NOT TILEPACK_${library}_FILE)
      message(FATAL_ERROR "tilepack needs lib${library}, which is not here")
    endif()
    add_library(tilepack::${library} UNKNOWN IMPORTED)
    set_target_properties(tilepack::${library} PROPERTIES IMPORTED_LOCATION "${TILEPACK_${library}_FILE}")
  endif()
endforeach()
