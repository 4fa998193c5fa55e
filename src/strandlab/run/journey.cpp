#include "strandlab/run/journey.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "strandlab/case/estimate.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/run/composition.hpp"
#include "strandlab/run/page.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/run/steps.hpp"

namespace strandlab::run {
namespace {

using cases::Step;

Journey start(const cases::Case& c, const Place& place, Step first, Step last, Observer& observer) {
  auto formed = form(c);
  if (last >= Step::kTest) refuse_untestable(formed);
  const double disk_bytes = cases::estimate(formed.c, formed.panel).disk_bytes;
  RunFolder folder(place.folder, formed.c, first, place.force, disk_bytes);
  begin_record(folder.record(), formed);
  return {std::move(formed), std::move(folder), Log(observer)};
}

// Takes the steps; what ends them is logged.
template <class Steps>
auto travel(const cases::Case& c, const Place& place, Step first, Step last, Observer& observer, const Steps& steps) {
  auto journey = start(c, place, first, last, observer);
  try {
    return steps(journey);
  } catch (const std::exception& e) {
    journey.log.keep_error(e.what());
    throw;
  }
}

bool is_there(const Journey& journey, Step step) {
  return journey.folder.finished(step) && journey.folder.missing(step, journey.formed.c).empty();
}

}  // namespace

void form_into(Journey& journey) {
  auto& folder = journey.folder;
  const auto& mat = journey.formed.mat;
  const auto file = folder.file("mat.json");
  if (is_there(journey, Step::kMat)) {
    if (files::read_text(file) != mat::to_text(mat)) {
      throw InputError(
          fmt::format("{}: not the mat of this case (changed by hand, or the mat file has changed since); choose "
                      "another run folder with -o, or --force",
                      file.string()));
    }
    return;
  }
  folder.forget(Step::kPage);
  mat::write(mat, file);
  folder.set_finished(Step::kMat);
  journey.log.say(fmt::format("mat: {} rows, {} strands -> {}", mat.layers.size(), journey.formed.panel.strands.size(),
                              file.string()));
  for (const auto& line : composition(cases::weigh(journey.formed.c, mat))) journey.log.say("mat: " + line);
}

// The report follows from the files that are there: a run does not fail for the want of its page.
void page_into(Journey& journey) {
  if (is_there(journey, Step::kPage)) return;
  try {
    const auto page = write_report_page(journey.folder.path());
    journey.folder.set_finished(Step::kPage);
    journey.log.say(fmt::format("report: {}", page.string()));
  } catch (const std::exception& e) {
    journey.log.warn(fmt::format("no report.html: {}", e.what()));
  }
}

void draw_plots(Journey& journey, Step step, const std::vector<report::Picture>& plots) {
  stop_if_cancelled(journey.log);
  const auto drawn = report::draw(plots);
  for (const auto& warning : drawn.warnings) journey.log.warn(warning);
  journey.folder.add_plots(step, drawn.pictures);
}

Formed form(const cases::Case& c, const Place& place, Observer& observer) {
  return travel(c, place, Step::kMat, Step::kMat, observer, [](Journey& journey) {
    const bool done = is_there(journey, Step::kMat);
    form_into(journey);
    if (done) journey.log.say("mat: already in " + journey.folder.path().string());
    return std::move(journey.formed);
  });
}

void press(const cases::Case& c, const Place& place, Observer& observer) {
  travel(c, place, Step::kPress, Step::kPress, observer, [](Journey& journey) {
    form_into(journey);
    press_into(journey);
  });
}

Tested test(const cases::Case& c, const Place& place, Observer& observer) {
  return travel(c, place, Step::kTest, Step::kTest, observer, test_into);
}

Tested all(const cases::Case& c, const Place& place, Observer& observer) {
  return travel(c, place, Step::kMat, Step::kPage, observer, [](Journey& journey) {
    const bool done =
        is_there(journey, Step::kMat) && is_there(journey, Step::kPress) && is_there(journey, Step::kTest);
    if (done) {
      page_into(journey);
      journey.log.say(fmt::format("{}: this run is finished; --force runs it again", journey.folder.path().string()));
      return tested_in(journey);
    }
    form_into(journey);
    press_into(journey);
    auto tested = test_into(journey);
    page_into(journey);
    return tested;
  });
}

}  // namespace strandlab::run
