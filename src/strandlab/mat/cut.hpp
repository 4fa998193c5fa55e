// What a section shows of whole strands, rectangles that lie at an angle to it: the line in which it cuts them.
#pragma once

#include "strandlab/core/random.hpp"
#include "strandlab/mat/angles.hpp"
#include "strandlab/mat/form.hpp"

namespace strandlab::mat {

// Whole strands that lie neither all along the section nor all across it.
bool are_cut(const StrandStatistics& strands, const AngleDistribution& angles);

// The strands of a row as the section shows them: without a width those given; of whole strands their length where all
// lie along the section and their width where all lie across it; else mean and standard deviation of the cuts, of
// strands of mean length and width. The mean is <L><W>/(<L><|sin|> + <W><|cos|>): a line meets a strand in proportion
// to its extent across the line, and what it cuts off is then on average the strand's area over that extent.
StrandStatistics in_section(const StrandStatistics& strands, const AngleDistribution& angles);

// Draws the cuts of whole strands.
class CutSource {
 public:
  struct Cut {
    double length_mm = 0, angle_deg = 0;
  };

  // Needs statistics with a width and angles that form() accepts.
  CutSource(const StrandStatistics& strands, const AngleDistribution& angles);
  // Of a strand that the line meets: length, width and angle in proportion to its extent across the line, the line
  // anywhere within that extent.
  Cut draw(RandomStream& random) const;
  double longest_mm() const { return longest_; }  // no cut is longer

 private:
  StrandStatistics strands_;
  AngleSampler angles_;
  double longest_;
};

}  // namespace strandlab::mat
