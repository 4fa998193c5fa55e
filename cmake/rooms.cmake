# Flags and helpers shared by all targets.
add_library(strandlab_flags INTERFACE)
target_compile_options(strandlab_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Woverloaded-virtual
  -fno-math-errno -ffp-contract=fast
  $<$<BOOL:${STRANDLAB_NATIVE}>:-march=native>)
if(STRANDLAB_SANITIZE)
  target_compile_options(strandlab_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(strandlab_flags INTERFACE -fsanitize=address,undefined)
endif()
if(STRANDLAB_TIDY)
  set(CMAKE_CXX_CLANG_TIDY clang-tidy --quiet)
endif()

# strandlab_room(name LINKS public... PRIVATE_LINKS private...): one library from src/strandlab/<name>/*.cpp
function(strandlab_room name)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/strandlab/${name}/*.cpp)
  if(sources)
    add_library(strandlab_${name} STATIC ${sources})
    target_include_directories(strandlab_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(strandlab_${name} PUBLIC ${ARG_LINKS} PRIVATE strandlab_flags ${ARG_PRIVATE_LINKS})
  else()  # a room of headers only
    add_library(strandlab_${name} INTERFACE)
    target_include_directories(strandlab_${name} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(strandlab_${name} INTERFACE ${ARG_LINKS} ${ARG_PRIVATE_LINKS})
  endif()
endfunction()
