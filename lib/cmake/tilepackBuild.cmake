# Packs as parts of a build, after find_package(tilepack):
#
#   tilepack_add_pack(gravel SAMPLE gravel.png OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/gravel.pack
#                     MAPS normal=gravel_n.png PRESET terrain OPTIONS --seed 7 --colors 3)
#   tilepack_add_manifest(textures MANIFEST textures.json OPTIONS --cache /mnt/share/packs)
#
# Both add a target of that name, which is part of `all`, and is made again when a file that was read changes: samples, maps,
# presets, the manifest, all that its patterns match. Of a manifest, tilepack itself decides by content which entries that
# concerns. Relative paths are meant from CMAKE_CURRENT_SOURCE_DIR, OUTPUT from CMAKE_CURRENT_BINARY_DIR; outputs of a
# manifest lie where it says. TILEPACK_PROGRAM is the program. No language needs to be enabled: project(game NONE) will do,
# and then find_package(tilepack) asks for no library and gives none.

find_program(TILEPACK_PROGRAM tilepack HINTS "${CMAKE_CURRENT_LIST_DIR}/../../../bin" "${CMAKE_CURRENT_LIST_DIR}/../../../../bin")

function(tilepack_add_pack name)
  cmake_parse_arguments(PARSE_ARGV 1 pack "" "SAMPLE;OUTPUT;PRESET" "MAPS;OPTIONS")
  if(NOT pack_SAMPLE OR NOT pack_OUTPUT OR pack_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tilepack_add_pack(NAME SAMPLE FILE OUTPUT DIR [MAPS ROLE=FILE...] [PRESET NAME|FILE] [OPTIONS ...])")
  endif()
  get_filename_component(sample "${pack_SAMPLE}" ABSOLUTE)
  get_filename_component(output "${pack_OUTPUT}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(words "${sample}" -o "${output}")
  set(sources "")
  if(EXISTS "${sample}" AND NOT IS_DIRECTORY "${sample}")
    list(APPEND sources "${sample}")
  endif()
  foreach(map IN LISTS pack_MAPS)
    if(NOT map MATCHES "^([^=]+)=(.+)$")
      message(FATAL_ERROR "tilepack_add_pack: MAPS takes ROLE=FILE, and not ${map}")
    endif()
    get_filename_component(file "${CMAKE_MATCH_2}" ABSOLUTE)
    list(APPEND words --map "${CMAKE_MATCH_1}=${file}")
    list(APPEND sources "${file}")
  endforeach()
  if(pack_PRESET)
    set(preset "${pack_PRESET}")
    if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${preset}")
      get_filename_component(preset "${preset}" ABSOLUTE)
      list(APPEND sources "${preset}")
    endif()
    list(APPEND words --preset "${preset}")
  endif()
  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/${name}.tilepack.d")
  add_custom_command(
    OUTPUT "${output}/pack.json"
    COMMAND "${TILEPACK_PROGRAM}" bake ${words} ${pack_OPTIONS} --wait --quiet --depfile "${depfile}"
    DEPENDS ${sources} "${TILEPACK_PROGRAM}"
    DEPFILE "${depfile}"
    COMMENT "Tile pack ${name}"
    VERBATIM)
  add_custom_target(${name} ALL DEPENDS "${output}/pack.json")
endfunction()

function(tilepack_add_manifest name)
  cmake_parse_arguments(PARSE_ARGV 1 batch "" "MANIFEST" "OPTIONS")
  if(NOT batch_MANIFEST OR batch_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tilepack_add_manifest(NAME MANIFEST FILE [OPTIONS ...])")
  endif()
  get_filename_component(manifest "${batch_MANIFEST}" ABSOLUTE)
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${name}.tilepack.stamp")
  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/${name}.tilepack.d")
  add_custom_command(
    OUTPUT "${stamp}"
    COMMAND "${TILEPACK_PROGRAM}" batch "${manifest}" ${batch_OPTIONS} --quiet --depfile "${depfile}" --stamp "${stamp}"
    DEPENDS "${manifest}" "${TILEPACK_PROGRAM}"
    DEPFILE "${depfile}"
    COMMENT "Tile packs of ${name}"
    VERBATIM)
  add_custom_target(${name} ALL DEPENDS "${stamp}")
endfunction()
