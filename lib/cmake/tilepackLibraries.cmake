# Libraries whose CMake packages in Debian 12 ask for more than they need, or that have none: OpenCV's core (all of
# OpenCV), Highway, xxHash. Read by tilepack's build and, installed, by find_package(tilepack).
foreach(library opencv_core hwy xxhash)
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
