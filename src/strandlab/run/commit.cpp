#include "strandlab/run/commit.hpp"

#include "git_hash.hpp"

namespace strandlab::run {

const char* git_commit() {
  return kGitHash;
}

}  // namespace strandlab::run
