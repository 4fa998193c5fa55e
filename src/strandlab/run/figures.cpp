#include "strandlab/run/figures.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "strandlab/case/write.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/io/checkpoint.hpp"
#include "strandlab/report/density_profiles.hpp"
#include "strandlab/report/plots.hpp"
#include "strandlab/report/section_picture.hpp"
#include "strandlab/report/theory_curves.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/press.hpp"
#include "strandlab/run/record.hpp"
#include "strandlab/run/test.hpp"
#include "strandlab/run/theory_rows.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;

void check(const report::Paper& paper) {
  if (!(paper.width_mm >= 30 && paper.width_mm <= 500))
    throw InputError(fmt::format("--width-mm {:g}: a figure is 30 to 500 mm wide", paper.width_mm));
  if (!(paper.font_pt >= 4 && paper.font_pt <= 40))
    throw InputError(fmt::format("--font-pt {:g}: letters have 4 to 40 points", paper.font_pt));
  bool plain = !paper.font.empty();
  for (const char c : paper.font)
    plain = plain && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ' || c == '-' || c == '.');
  if (!plain)
    throw InputError(
        fmt::format("--font {}: the name of a font is letters, digits, spaces, - and .", shortened(paper.font)));
}

const char* suffix(report::PaperFormat format) {
  switch (format) {
    case report::PaperFormat::kPdf:
      return ".pdf";
    case report::PaperFormat::kSvg:
      return ".svg";
    case report::PaperFormat::kPng:
      return ".png";
  }
  __builtin_unreachable();
}

class Figures {
 public:
  Figures(const fs::path& run_folder, fs::path out, const report::Paper& paper)
      : run_(run_folder),
        out_(std::move(out)),
        paper_(paper),
        record_(read_run_record(run_folder)),
        formed_(form(read_run_case(run_folder))),
        hash_(cases::case_hash(formed_.c, cases::Step::kPress)) {}

  report::Drawn draw() {
    for (const double compaction : formed_.c.schedule.compactions) {
      const auto file = run_ / "panels" / fmt::format("panel_{}.h5", compaction);
      if (!fs::exists(file))
        throw InputError(
            fmt::format("{}: holds no pressed panel yet: strandlab press (or run) comes first", run_.string()));
      panels_.push_back(io::read_panel<2>(file, hash_));
    }
    files::make_folder(out_);
    report::Drawn drawn;
    draw_sections(drawn);
    add_press();
    add_moduli();
    auto plotted = report::draw(plots_, {}, paper_);
    drawn.pictures.insert(drawn.pictures.end(), plotted.pictures.begin(), plotted.pictures.end());
    drawn.warnings = std::move(plotted.warnings);
    return drawn;
  }

 private:
  fs::path file(const std::string& name) const { return out_ / (name + suffix(paper_.format)); }
  void add(report::Plot plot, const std::string& name) { plots_.push_back({std::move(plot), file(name)}); }

  void draw_sections(report::Drawn& drawn) const {
    std::vector<const Panel<2>*> all;
    all.reserve(panels_.size());
    for (const auto& panel : panels_) all.push_back(&panel);
    for (const auto& [colouring, name] : {std::pair{report::Colouring::kGrainAngle, "grain_angle"},
                                          std::pair{report::Colouring::kDensity, "density"}}) {
      report::PictureOptions options;
      options.colouring = colouring;
      options.range = report::common_range(all, colouring);
      options.paper = paper_;
      for (std::size_t i = 0; i < panels_.size(); ++i) {
        const auto picture = file(fmt::format("section_{}_{}", name, formed_.c.schedule.compactions[i]));
        report::draw_section(panels_[i], options, picture);
        drawn.pictures.push_back(picture);
      }
    }
  }

  // The stress is of the last checkpoint; a run without one has its other figures.
  void add_press() {
    const auto last = io::CheckpointStore(run_, hash_).load<2>(nullptr);
    if (last) add(report::stress_plot(last->records), "stress");
    const auto shapes = shapes_of(formed_.c, panels_);
    add(report::profile_plot(shapes.density_profiles), "density_profile");
    add(report::grain_angle_plot(shapes.morphologies), "grain_angles");
    add(report::thickness_strain_plot(shapes.morphologies), "thickness_strains");
  }

  void add_moduli() {
    const nlohmann::json::json_pointer states("/steps/test/states");
    if (!record_.contains(states)) return;
    const auto& c = formed_.c;
    const auto moduli = moduli_of(formed_, tested_from_json(record_.at(states)));
    const auto theory = report::theory_moduli(theory_rows(c, formed_.mat), moduli, c.off_axis);
    const auto name = [&c](double compliance_t) { return cases::name_of_glue(c, compliance_t); };
    for (const auto kind : c.test.kinds) {
      const std::string test = vtest::name(kind);
      add(report::compliance_plot(moduli, test, report::theory_against_compliance(theory, test)),
          test + "_against_compliance");
      add(report::compaction_plot(moduli, test, report::theory_against_compaction(theory, test), name),
          test + "_against_compaction");
    }
  }

  fs::path run_, out_;
  report::Paper paper_;
  nlohmann::json record_;
  Formed formed_;
  std::string hash_;
  std::vector<Panel<2>> panels_;
  std::vector<report::Picture> plots_;
};

}  // namespace

report::Drawn draw_figures(const fs::path& run_folder, const fs::path& out, const report::Paper& paper) {
  check(paper);
  return Figures(run_folder, out, paper).draw();
}

}  // namespace strandlab::run
