# Flags and helpers shared by all targets.
add_library(strandlab_flags INTERFACE)
target_compile_options(strandlab_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:GNU>:-Wzero-as-null-pointer-constant>  # clang 14 takes a defaulted <=> for one
  -Wredundant-decls
  -fno-math-errno -ffp-contract=fast
  -fno-semantic-interposition  # position-independent, but our functions call and inline each other as in a program
  # g++ 12 warns of its own AVX-512 intrinsics under Eigen (GCC bug 105593)
  $<$<AND:$<BOOL:${STRANDLAB_NATIVE}>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized;-Wno-uninitialized>
  $<$<BOOL:${STRANDLAB_NATIVE}>:-march=native>
  # g++ 12 warns about its own AVX-512 intrinsics and about packs filled lane by lane.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(STRANDLAB_SANITIZE)
  target_compile_options(strandlab_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(strandlab_flags INTERFACE -fsanitize=address,undefined)
endif()
# Tests, most of all with sanitizers, are many large programs: mold links them in a tenth of the time.
if(STRANDLAB_TESTS OR STRANDLAB_SANITIZE)
  find_program(STRANDLAB_MOLD mold)
  if(STRANDLAB_MOLD)
    target_link_options(strandlab_flags INTERFACE -fuse-ld=mold)
  endif()
endif()
if(STRANDLAB_WERROR)
  target_compile_options(strandlab_flags INTERFACE -Werror)
endif()
if(STRANDLAB_FUZZ)  # every room counts its branches, for the fuzzers to find new ones
  target_compile_options(strandlab_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# What only moves files, words and tables about is compiled for quick building: little of a run's time goes there.
set(strandlab_quick_to_build $<IF:$<BOOL:${STRANDLAB_SANITIZE}>,-O0,$<$<CONFIG:Release>:-O1>>)
set(strandlab_quick_rooms files table statistics theory profile bondline case io report run study)

# Headers that nearly every source reads are compiled once for all with the same options: one to three seconds
# less for a source that takes five to ten.
# Sources still name what they use: scripts/tidy reads them without. Not for the kernels, each with an instruction set of its own.
# Nor with a launcher: a cache of compiled files finds more without.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
set(strandlab_common_headers <Eigen/Geometry> <Eigen/LU> <fmt/format.h> <fmt/ranges.h> <algorithm> <cmath> <filesystem>
  <functional> <map> <optional> <string> <vector>)
function(strandlab_precompile group)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS;OPTIONS" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled/${group}.cpp CONTENT "")
  add_library(strandlab_precompiled_${group} OBJECT EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/precompiled/${group}.cpp)
  target_compile_features(strandlab_precompiled_${group} PRIVATE cxx_std_20)
  target_compile_options(strandlab_precompiled_${group} PRIVATE ${ARG_OPTIONS})
  target_link_libraries(strandlab_precompiled_${group} PRIVATE strandlab_flags Eigen3::Eigen fmt::fmt Threads::Threads ${ARG_LINKS})
  target_precompile_headers(strandlab_precompiled_${group} PRIVATE ${strandlab_common_headers} ${ARG_HEADERS})
endfunction()
strandlab_precompile(rooms)
strandlab_precompile(quick_rooms OPTIONS ${strandlab_quick_to_build} HEADERS <nlohmann/json.hpp> LINKS nlohmann_json::nlohmann_json)

# strandlab_room(name LINKS public... PRIVATE_LINKS private...): one library from src/strandlab/<name>/ and its folders, installed as
# strandlab::<name>
function(strandlab_room name)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/strandlab/${name}/*.cpp
       ${PROJECT_SOURCE_DIR}/src/strandlab/${name}/*/*.cpp)
  if(sources)
    list(FILTER sources EXCLUDE REGEX "/mpm/kernels\\.cpp$")  # see strandlab_kernel_builds
    add_library(strandlab_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(strandlab_${name} PUBLIC ${ARG_LINKS} PRIVATE $<BUILD_INTERFACE:strandlab_flags>
      ${ARG_PRIVATE_LINKS})
  else()  # a room of headers only
    add_library(strandlab_${name} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(strandlab_${name} INTERFACE ${ARG_LINKS} ${ARG_PRIVATE_LINKS})
  endif()
  target_include_directories(strandlab_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:include>)
  target_compile_features(strandlab_${name} ${scope} cxx_std_20)
  if(sources AND name IN_LIST strandlab_quick_rooms)
    target_compile_options(strandlab_${name} PRIVATE ${strandlab_quick_to_build})
    target_precompile_headers(strandlab_${name} REUSE_FROM strandlab_precompiled_quick_rooms)
  elseif(sources)
    target_precompile_headers(strandlab_${name} REUSE_FROM strandlab_precompiled_rooms)
  endif()
  set_target_properties(strandlab_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS strandlab_${name} EXPORT strandlab)
endfunction()

# One object library per instruction set from mpm/kernels.cpp, each in a namespace of its own.
function(strandlab_kernel_builds)
  set(source ${PROJECT_SOURCE_DIR}/src/strandlab/mpm/kernels.cpp)
  set(builds generic)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT STRANDLAB_SANITIZE
     AND NOT STRANDLAB_ONE_KERNEL_BUILD)
    list(APPEND builds avx2 avx512)
    target_compile_definitions(strandlab_mpm PRIVATE STRANDLAB_X86_BUILDS)
  endif()
  set(flags_avx2 -march=x86-64-v3)
  set(flags_avx512 -march=x86-64-v4)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    list(APPEND flags_avx512 -mprefer-vector-width=512)
  endif()
  foreach(build ${builds})
    add_library(strandlab_kernels_${build} OBJECT ${source})
    target_include_directories(strandlab_kernels_${build} PRIVATE ${PROJECT_SOURCE_DIR}/src)
    target_compile_definitions(strandlab_kernels_${build} PRIVATE STRANDLAB_ISA=${build})
    target_link_libraries(strandlab_kernels_${build} PRIVATE strandlab_flags)
    # -Wno-psabi: packs are never passed between builds, so their calling convention does not matter.
    target_compile_options(strandlab_kernels_${build} PRIVATE $<$<NOT:$<BOOL:${STRANDLAB_SANITIZE}>>:-O3> -Wno-psabi
      ${flags_${build}})
    target_sources(strandlab_mpm PRIVATE $<TARGET_OBJECTS:strandlab_kernels_${build}>)
  endforeach()
endfunction()
