# `cmake --install BUILD --prefix PREFIX`: the program, the library with its headers, and what find_package needs.
# Nothing in it names a folder of this machine, so PREFIX may be moved.
include(CMakePackageConfigHelpers)

set(tilepack_package ${CMAKE_INSTALL_LIBDIR}/cmake/tilepack)
set(tilepack_share ${CMAKE_INSTALL_DATADIR}/tilepack)

file(RELATIVE_PATH modules_from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR}/tilepack)
set_target_properties(tilepack_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${modules_from_bin};$ORIGIN/modules")
install(TARGETS tilepack_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS tilepack_openimageio LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/tilepack)
install(TARGETS tilepack_runtime tilepack EXPORT tilepackTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/lib/tilepack/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tilepack
  FILES_MATCHING
  PATTERN *.h)
install(FILES ${PROJECT_SOURCE_DIR}/lib/tilepack/pack/pack.schema.json ${PROJECT_SOURCE_DIR}/lib/tilepack/check/report.schema.json
              ${PROJECT_SOURCE_DIR}/lib/tilepack/batch/manifest.schema.json
              ${PROJECT_SOURCE_DIR}/lib/tilepack/batch/batch_log.schema.json
              ${PROJECT_SOURCE_DIR}/lib/tilepack/scene/scene.schema.json
        DESTINATION ${tilepack_share})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets DESTINATION ${tilepack_share})

# Manual pages and completion, which the program itself prints, so that they are those of its verbs and options.
install(DIRECTORY ${TILEPACK_MADE}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
install(FILES ${TILEPACK_MADE}/completion/bash/tilepack DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${TILEPACK_MADE}/completion/zsh/_tilepack DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${TILEPACK_MADE}/completion/fish/tilepack.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# In a folder where find_package doesn't look: the folder of the program may be on the PATH, whose folders it takes for prefixes,
# and what is made here serves only where it is installed.
set(tilepack_to_install ${PROJECT_BINARY_DIR}/to_install)
file(REMOVE ${PROJECT_BINARY_DIR}/tilepackConfig.cmake ${PROJECT_BINARY_DIR}/tilepackConfigVersion.cmake) # older builds' place
install(EXPORT tilepackTargets NAMESPACE tilepack:: DESTINATION ${tilepack_package})
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/tilepackConfig.cmake.in ${tilepack_to_install}/tilepackConfig.cmake
  INSTALL_DESTINATION ${tilepack_package}
  PATH_VARS tilepack_share)
# Before 1.0 a minor version may break what was.
write_basic_package_version_file(${tilepack_to_install}/tilepackConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${tilepack_to_install}/tilepackConfig.cmake ${tilepack_to_install}/tilepackConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/tilepackLibraries.cmake ${CMAKE_CURRENT_LIST_DIR}/tilepackBuild.cmake DESTINATION ${tilepack_package})
