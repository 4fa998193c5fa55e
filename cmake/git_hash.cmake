# Writes a header with the commit of the source tree; runs at every build and touches the header only when it changes.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT hash)
  set(hash "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "inline constexpr const char* kGitHash = \"${hash}\";\n" @ONLY)
