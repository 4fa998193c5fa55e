// What is made of a run folder to look at. strandlab report: its page; strandlab figures: for paper; strandlab movie:
// the pressing as a film, by ffmpeg.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/figures.hpp"
#include "strandlab/run/film.hpp"
#include "strandlab/run/measured.hpp"
#include "strandlab/run/page.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_report(CLI::App& app) {
  struct ReportArguments {
    std::string folder, out;
    std::vector<std::filesystem::path> measured;
  };
  auto arguments = std::make_shared<ReportArguments>();
  auto* command = app.add_subcommand("report", "make report.html of a run folder again");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "file to write (default: report.html in the run folder)");
  command->add_option("--measured", arguments->measured,
                      "densitometer tables of boards like this one: their mean is drawn over the panel's density "
                      "profiles; kept in the run folder as measured.csv");
  command->callback([arguments] {
    if (!arguments->measured.empty()) run::keep_measured(arguments->folder, arguments->measured);
    print("report: {}\n", printable(run::remake_page(arguments->folder, arguments->out).string()));
  });
}

void add_figures(CLI::App& app) {
  struct FigureArguments {
    std::string folder, out, format = "pdf";
    report::Paper paper;
  };
  auto arguments = std::make_shared<FigureArguments>();
  auto* command = app.add_subcommand("figures", "the plots and sections of a run folder for a paper (PDF, SVG, PNG)");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "folder to write into (default: figures in the run folder)");
  command->add_option("--format", arguments->format, "pdf, svg, or png of 300 dpi")
      ->check(CLI::IsMember({"pdf", "svg", "png"}))
      ->capture_default_str();
  command->add_option("--width-mm", arguments->paper.width_mm, "width of each figure")->capture_default_str();
  command->add_option("--font", arguments->paper.font, "font of all letters")->capture_default_str();
  command->add_option("--font-pt", arguments->paper.font_pt, "their size in points")->capture_default_str();
  command->callback([arguments] {
    auto& a = *arguments;
    if (a.format == "svg") a.paper.format = report::PaperFormat::kSvg;
    if (a.format == "png") a.paper.format = report::PaperFormat::kPng;
    const auto out = a.out.empty() ? std::filesystem::path(a.folder) / "figures" : std::filesystem::path(a.out);
    const auto drawn = run::draw_figures(a.folder, out, a.paper);
    for (const auto& warning : drawn.warnings) warn(warning);
    print("figures: {} -> {}\n", drawn.pictures.size(), printable(out.string()));
  });
}

void add_movie(CLI::App& app) {
  struct MovieArguments {
    std::string folder, out = "press.mp4", colour = "grain_angle";
    run::FilmOptions film;
  };
  auto arguments = std::make_shared<MovieArguments>();
  auto* command = app.add_subcommand("movie", "the pressing of a run folder as a film (.mp4 or .gif), by ffmpeg");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "film to write")->capture_default_str();
  command->add_option("--colour", arguments->colour, "what the strands are coloured by")
      ->check(CLI::IsMember({"grain_angle", "density"}))
      ->capture_default_str();
  command->add_option("--fps", arguments->film.frames_per_s, "frames a second")->capture_default_str();
  command->add_option("--width", arguments->film.width_px, "width in pixels")->capture_default_str();
  command->callback([arguments] {
    auto& a = *arguments;
    if (a.colour == "density") a.film.colouring = report::Colouring::kDensity;
    const auto frames = run::make_film(a.folder, a.out, a.film);
    print("movie: {} frames -> {}\n", frames, printable(a.out));
  });
}

}  // namespace strandlab::app
