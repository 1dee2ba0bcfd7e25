# A library that has no CMake package in Debian 12: xxHash. Read by tilepack's build and, installed, by
# find_package(tilepack).
if(NOT TARGET tilepack::xxhash)
  find_library(TILEPACK_xxhash_FILE xxhash)
  mark_as_advanced(TILEPACK_xxhash_FILE)
  if(NOT TILEPACK_xxhash_FILE)
    message(FATAL_ERROR "tilepack needs libxxhash, which is not here")
  endif()
  add_library(tilepack::xxhash UNKNOWN IMPORTED)
  set_target_properties(tilepack::xxhash PROPERTIES IMPORTED_LOCATION "${TILEPACK_xxhash_FILE}")
endif()
