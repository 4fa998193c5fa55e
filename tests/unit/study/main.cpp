// These tests fork, so they start as the program does: OpenBLAS told to start no threads when it is loaded.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

int main(int argc, char** argv) {
  constexpr const char* kThreads = "OPENBLAS_NUM_THREADS";
  if (::getenv(kThreads) == nullptr && ::setenv(kThreads, "1", 1) == 0) ::execv("/proc/self/exe", argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
