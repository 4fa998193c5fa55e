// A study for a queue: which items, in which chunks, with which limits.
#include "strandlab/study/cluster.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "samples.hpp"
#include "strandlab/study/claim.hpp"

namespace strandlab::study {
namespace {

using testing::HasSubstr;

// Six items of a study that is nowhere, each of so many seconds and 1 GB.
Study made_up_study(double seconds) {
  Study study{"nowhere", {}, {}};
  for (int i = 1; i <= 6; ++i)
    study.items.push_back({i, std::string(15, '0') + std::to_string(i), "", 1, 1, seconds, 1e9, {}});
  return study;
}

// A task of less than a quarter of an hour costs a queue more than it brings.
TEST(StudySlurm, ChunksTakeAQuarterOfAnHour) {
  const auto arrays = slurm_arrays(made_up_study(400), 1000);
  ASSERT_EQ(arrays.size(), 1U);
  ASSERT_EQ(arrays[0].chunks.size(), 2U);
  EXPECT_EQ(arrays[0].chunks[0].size(), 3U);  // 1200 s
  EXPECT_EQ(arrays[0].minutes, 50);           // twice 1200 s, and ten minutes
  EXPECT_EQ(arrays[0].megabytes, 1600);
  EXPECT_EQ(slurm_arrays(made_up_study(1000), 1000)[0].chunks.size(), 6U);
}

TEST(StudySlurm, ArraysAreSplitAtTheLargest) {
  const auto arrays = slurm_arrays(made_up_study(1000), 4);
  ASSERT_EQ(arrays.size(), 2U);
  EXPECT_EQ(arrays[0].chunks.size(), 4U);
  EXPECT_EQ(arrays[1].chunks.size(), 2U);
}

TEST(StudySlurm, ItemsAtWorkAreLeftAlone) {
  const test::TemporaryFolder folder;
  auto study = made_up_study(1000);
  study.folder = folder.path();
  const auto claim = Claim::attempt(study.item_folder(study.items[2]));
  EXPECT_EQ(slurm_arrays(study, 1000)[0].chunks.size(), 5U);
}

TEST(StudySlurm, AScriptNamesFoldersWithSpacesAsOneWord) {
  auto study = made_up_study(1000);
  study.folder = "/data/it's here";
  const auto script = slurm_script(study, slurm_arrays(study, 10)[0], "/data/it's here/slurm/array_1.txt",
                                   "/bin/strandlab", Keep::kModuli);
  EXPECT_THAT(script, HasSubstr("#SBATCH --array=1-6\n"));
  EXPECT_THAT(script, HasSubstr("'/bin/strandlab' study item '/data/it'\\''s here' $(sed -n"));
  EXPECT_THAT(script, HasSubstr("--keep moduli"));
}

TEST(StudyExport, ListsWhatIsNotWhole) {
  const auto list = parallel_list(made_up_study(1), "strandlab");
  EXPECT_THAT(list, HasSubstr("/nowhere' 0000000000000006\n"));
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 6);
  EXPECT_THAT(snakefile(made_up_study(1), "strandlab"), HasSubstr("resources: mem_mb=1500\n"));
  EXPECT_THAT(snakefile(made_up_study(1), "strandlab"), HasSubstr("{wildcards.item}"));
}

}  // namespace
}  // namespace strandlab::study
