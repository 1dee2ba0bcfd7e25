# Installs the build, moves what was installed elsewhere, builds samples/example against it and runs it. Run by
# ctest with -D SOURCE, BUILD, WORK, COMPILER, FLAGS, BUILD_TYPE.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${output}\nended with ${result}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Who has built the program alone, as the quick start does, can install: all that is installed from the build is made
# by then, or by what configures it.
find_program(NINJA ninja)
if(NINJA AND EXISTS ${BUILD}/build.ninja)
  run(${NINJA} -C ${BUILD} -t commands tilepack_cli)
  set(commands "${output}")
  file(READ ${BUILD}/cmake_install.cmake installed)
  string(REGEX MATCHALL "FILES \"${BUILD}/[^\"]+\"" installed "${installed}")
  list(TRANSFORM installed REPLACE "FILES \"${BUILD}/([^\"]+)\"" "\\1")
  list(FILTER installed EXCLUDE REGEX "^CMakeFiles/Export/")
  if(NOT "tilepack" IN_LIST installed OR NOT "made/man1" IN_LIST installed)
    message(FATAL_ERROR "what is installed is not found any more: ${installed}")
  endif()
  foreach(name IN LISTS installed)
    string(REGEX REPLACE "^made/.*" "-D FOLDER=${BUILD}/made " made ${name})
    string(FIND "${commands}" "${made}" at)
    if(at EQUAL -1 AND NOT name MATCHES "^to_install/")
      message(FATAL_ERROR "--target tilepack_cli does not make ${name}, which is installed")
    endif()
  endforeach()
endif()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)

# No folder of this machine in what other projects read.
file(GLOB_RECURSE package ${WORK}/moved/*.cmake)
foreach(file ${package})
  file(READ ${file} text)
  foreach(folder ${SOURCE} ${BUILD} ${WORK})
    string(FIND "${text}" "${folder}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file} names ${folder}")
    endif()
  endforeach()
endforeach()
foreach(file bin/tilepack include/tilepack/bake/bake.h share/tilepack/pack.schema.json share/tilepack/presets/default.json
             share/tilepack/manifest.schema.json share/tilepack/batch_log.schema.json share/man/man1/tilepack.1
             share/man/man1/tilepack-batch.1 share/bash-completion/completions/tilepack share/zsh/site-functions/_tilepack
             share/fish/vendor_completions.d/tilepack.fish)
  if(NOT EXISTS ${WORK}/moved/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/samples/example -B ${WORK}/example -D CMAKE_PREFIX_PATH=${WORK}/moved
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_BUILD_TYPE=${BUILD_TYPE})
run(${CMAKE_COMMAND} --build ${WORK}/example)

# Libraries that take long to load are not among those that are loaded at every start.
find_program(READELF readelf REQUIRED)
run(${READELF} -d ${WORK}/moved/bin/tilepack)
if(output MATCHES "NEEDED[^\n]*(opencv|hwy|OpenImageIO)" OR NOT output MATCHES "NEEDED")
  message(FATAL_ERROR "tilepack links\n${output}")
endif()

# What only looks packs up links no part of what makes them.
run(${READELF} -d ${WORK}/example/look_up)
if(output MATCHES "NEEDED[^\n]*(xxhash|opencv|hwy|OpenImageIO)" OR NOT output MATCHES "NEEDED")
  message(FATAL_ERROR "look_up links\n${output}")
endif()
# Its headers compile, the highest room's first so that each brings what it needs, and include nothing of those rooms.
set(program "")
foreach(room scanline sampler lookup pack mapping mip layout tileset image json numeric error)
  file(GLOB headers RELATIVE ${WORK}/moved/include ${WORK}/moved/include/tilepack/${room}/*.h)
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$")
  if(NOT headers)
    message(FATAL_ERROR "no headers of ${room} are installed")
  endif()
  foreach(header ${headers})
    string(APPEND program "#include <${header}>\n")
  endforeach()
endforeach()
file(WRITE ${WORK}/headers.cpp "${program}")
run(${COMPILER} -std=c++20 -fsyntax-only -H -I${WORK}/moved/include ${WORK}/headers.cpp)
string(REGEX MATCH "tilepack/(exemplar|match|seam|synth|bake|batch|check|measure|bench|report)/[^\n]*" foreign "${output}")
if(foreign OR NOT output MATCHES "tilepack/pack/pack\\.h")
  message(FATAL_ERROR "the headers for looking packs up include ${foreign}")
endif()

# EXR files need the module that is loaded when first needed: both programs find the one installed.
# Under sanitizers other tests look for leaks: the tracer that does it at exit follows LD_DEBUG too, and can fail.
run(${CMAKE_COMMAND} -E env LD_DEBUG=files ASAN_OPTIONS=detect_leaks=0 ${WORK}/moved/bin/tilepack bake ${SOURCE}/samples/pebbles.png -o ${WORK}/pack
    --format exr --tile-size 32 --effort 0)
string(REGEX MATCH "calling init: ${WORK}/moved/[^\n]*/libtilepack_openimageio.so" found "${output}")
if(NOT found)
  message(FATAL_ERROR "the installed program does not load the installed module")
endif()
run(${CMAKE_COMMAND} -E env LD_DEBUG=files ASAN_OPTIONS=detect_leaks=0 ${WORK}/example/look_up ${WORK}/pack)
string(REGEX MATCH "calling init: ${WORK}/moved/[^\n]*/libtilepack_openimageio.so" found "${output}")
if(NOT found)
  message(FATAL_ERROR "a program that uses tilepack does not load the installed module")
endif()

run(${WORK}/example/look_up ${WORK}/pack/pack.json)
# Three points, each a coordinate and three channels.
set(value " +[0-9]+\\.[0-9]+")
if(NOT output MATCHES "^(${value}${value}${value}${value}\n)(${value}${value}${value}${value}\n)(${value}${value}${value}${value}\n)$")
  message(FATAL_ERROR "look_up printed\n${output}")
endif()

# Packs are targets of another project's build, of one without a language too; it finds what is installed through the
# PATH, on which the folder that the program was built in may stand before.
file(WRITE ${WORK}/build/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(packs LANGUAGES NONE)
find_package(tilepack 0.1 REQUIRED)
if(NOT tilepack_DIR MATCHES \"^${WORK}/moved/\")
  message(FATAL_ERROR \"found \${tilepack_DIR}\")
endif()
tilepack_add_pack(pebbles SAMPLE ${SOURCE}/samples/pebbles.png OUTPUT pebbles.pack OPTIONS --tile-size 32 --effort 0)
")
run(${CMAKE_COMMAND} -E env "PATH=${BUILD}:${WORK}/moved/bin:$ENV{PATH}" ${CMAKE_COMMAND} -G Ninja -S ${WORK}/build -B ${WORK}/build/made)
run(${CMAKE_COMMAND} --build ${WORK}/build/made)
run(${WORK}/moved/bin/tilepack validate ${WORK}/build/made/pebbles.pack)
run(${CMAKE_COMMAND} --build ${WORK}/build/made)
if(NOT output MATCHES "no work to do")
  message(FATAL_ERROR "a second build made something:\n${output}")
endif()
file(REMOVE_RECURSE ${WORK})
