#pragma once

namespace strandlab::run {

// The commit of the source tree that was built, "-dirty" where it was changed; "unknown" where there was no git.
const char* git_commit();

}  // namespace strandlab::run
