// For the leak checker of the debug build: fontconfig keeps its caches to the end of the program. To be included by one
// file of a test program that draws pictures.
#pragma once

extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libfontconfig";
}
