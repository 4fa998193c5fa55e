// What is made of a run folder to look at. strandlab report: its page; strandlab movie: the pressing as a film, by
// ffmpeg.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "commands.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/run/film.hpp"
#include "strandlab/run/page.hpp"
#include "terminal.hpp"

namespace strandlab::app {

void add_report(CLI::App& app) {
  struct ReportArguments {
    std::string folder, out;
  };
  auto arguments = std::make_shared<ReportArguments>();
  auto* command = app.add_subcommand("report", "make report.html of a run folder again");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "file to write (default: report.html in the run folder)");
  command->callback(
      [arguments] { print("report: {}\n", printable(run::remake_page(arguments->folder, arguments->out).string())); });
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
