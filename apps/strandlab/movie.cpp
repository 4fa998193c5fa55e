// strandlab movie: the pressing of a run folder as a film, by ffmpeg.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "strandlab/case/case.hpp"
#include "strandlab/core/error.hpp"
#include "strandlab/core/text.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/report/section_picture.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/page.hpp"

namespace strandlab::app {
namespace {

namespace fs = std::filesystem;

struct MovieArguments {
  std::string folder, out = "press.mp4", colour = "grain_angle";
  double frames_per_s = 10;
  int width_px = 1600;
};

// A scratch folder that goes away with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "strandlab_movie_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw RunError("cannot make a temporary folder: " + std::generic_category().message(errno));
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Whether a program of this name is on the PATH.
bool is_installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

// Runs ffmpeg with its complaints in `log`. Throws RunError, with the end of them, when it fails.
void run_ffmpeg(std::vector<std::string> arguments, const fs::path& log) {
  arguments.insert(arguments.begin(), {"ffmpeg", "-nostdin", "-y", "-loglevel", "error"});
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, "ffmpeg", &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw RunError("cannot run ffmpeg: " + std::generic_category().message(failure));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  constexpr std::size_t kShown = 500;
  auto complaints = read_text(log);
  if (complaints.size() > kShown) complaints.erase(0, complaints.size() - kShown);
  throw RunError("ffmpeg could not make the film: " + (complaints.empty() ? "it said nothing" : complaints));
}

void check(const MovieArguments& a, const std::string& extension) {
  if (extension != ".mp4" && extension != ".gif") {
    throw InputError(fmt::format("{}: a film is an .mp4 or a .gif file", a.out));
  }
  if (!(a.frames_per_s >= 0.5 && a.frames_per_s <= 60)) {
    throw InputError(fmt::format("--fps {}: 0.5 to 60 frames a second are possible", a.frames_per_s));
  }
  if (!is_installed("ffmpeg")) {
    throw InputError(
        "ffmpeg is not installed and makes the film: on Debian, apt-get install ffmpeg. The pictures of each "
        "compaction are in the run folder without it, and report.html plays the pressing");
  }
}

// Numbered pictures of all frames, in the same colours. Returns how many.
std::size_t draw_frames(const MovieArguments& a, const ScratchFolder& scratch) {
  const fs::path folder = a.folder;
  static_cast<void>(run::read_run_record(folder));
  const auto frames = run::read_frames(folder);
  if (frames.empty()) throw InputError(fmt::format("{}: holds no pressed panel yet", a.folder));
  std::vector<const Panel<2>*> all;
  all.reserve(frames.size());
  for (const auto& frame : frames) all.push_back(&frame);
  report::PictureOptions options;
  options.colouring = a.colour == "density" ? report::Colouring::kDensity : report::Colouring::kGrainAngle;
  options.range = report::common_range(all, options.colouring);
  options.width_px = a.width_px;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    report::draw_section(frames[i], options, scratch / fmt::format("frame_{:03}.png", i));
  }
  return frames.size();
}

void make_movie(const MovieArguments& a) {
  const auto extension = fs::path(a.out).extension().string();
  check(a, extension);
  const ScratchFolder scratch;
  const auto count = draw_frames(a, scratch);
  const auto film = scratch / ("film" + extension);
  std::vector<std::string> arguments{"-framerate", fmt::format("{}", a.frames_per_s), "-i",
                                     (scratch / "frame_%03d.png").string()};
  const std::vector<std::string> encoding =
      extension == ".mp4"  // players want even sizes and this colour format
          ? std::vector<std::string>{"-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                                     "-c:v",      "libx264",
                                     "-pix_fmt",  "yuv420p",
                                     "-movflags", "+faststart"}
          : std::vector<std::string>{"-vf", "split[a][b];[a]palettegen[p];[b][p]paletteuse"};
  arguments.insert(arguments.end(), encoding.begin(), encoding.end());
  arguments.push_back(film.string());
  run_ffmpeg(arguments, scratch / "ffmpeg.log");
  files::write_atomically(a.out, read_text(film));
  print("movie: {} frames -> {}\n", count, printable(a.out));
}

}  // namespace

void add_movie(CLI::App& app) {
  auto arguments = std::make_shared<MovieArguments>();
  auto* command = app.add_subcommand("movie", "the pressing of a run folder as a film (.mp4 or .gif), by ffmpeg");
  command->add_option("DIR", arguments->folder, "run folder")->required();
  command->add_option("-o,--output", arguments->out, "film to write")->capture_default_str();
  command->add_option("--colour", arguments->colour, "what the strands are coloured by")
      ->check(CLI::IsMember({"grain_angle", "density"}))
      ->capture_default_str();
  command->add_option("--fps", arguments->frames_per_s, "frames a second")->capture_default_str();
  command->add_option("--width", arguments->width_px, "width in pixels")->capture_default_str();
  command->callback([arguments] { make_movie(*arguments); });
}

}  // namespace strandlab::app
