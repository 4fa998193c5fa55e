#include "strandlab/run/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <system_error>
#include <vector>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/files/text_file.hpp"
#include "strandlab/report/section_picture.hpp"
#include "strandlab/run/folder.hpp"
#include "strandlab/run/installed.hpp"
#include "strandlab/run/page.hpp"

namespace strandlab::run {
namespace {

namespace fs = std::filesystem;

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
  auto complaints = files::read_text(log).value_or("");
  if (complaints.size() > kShown) complaints.erase(0, complaints.size() - kShown);
  throw RunError("ffmpeg could not make the film: " + (complaints.empty() ? "it said nothing" : complaints));
}

void check(const fs::path& out, const FilmOptions& options) {
  const auto extension = out.extension().string();
  if (extension != ".mp4" && extension != ".gif") {
    throw InputError(fmt::format("{}: a film is an .mp4 or a .gif file", out.string()));
  }
  if (!(options.frames_per_s >= 0.5 && options.frames_per_s <= 60)) {
    throw InputError(fmt::format("--fps {}: 0.5 to 60 frames a second are possible", options.frames_per_s));
  }
  if (!installed("ffmpeg")) {
    throw InputError(
        "ffmpeg is not installed and makes the film: on Debian, apt-get install ffmpeg. The pictures of each "
        "compaction are in the run folder without it, and report.html plays the pressing");
  }
}

// Numbered pictures of all frames, in the same colours. Returns how many.
std::size_t draw_frames(const fs::path& run_folder, const FilmOptions& film, const ScratchFolder& scratch) {
  static_cast<void>(read_run_record(run_folder));
  const auto frames = read_frames(run_folder);
  if (frames.empty()) throw InputError(fmt::format("{}: holds no pressed panel yet", run_folder.string()));
  std::vector<const Panel<2>*> all;
  all.reserve(frames.size());
  for (const auto& frame : frames) all.push_back(&frame);
  report::PictureOptions options;
  options.colouring = film.colouring;
  options.range = report::common_range(all, options.colouring);
  options.width_px = film.width_px;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    report::draw_section(frames[i], options, scratch / fmt::format("frame_{:03}.png", i));
  }
  return frames.size();
}

}  // namespace

std::size_t make_film(const fs::path& run_folder, const fs::path& out, const FilmOptions& options) {
  check(out, options);
  const auto extension = out.extension().string();
  const ScratchFolder scratch;
  const auto count = draw_frames(run_folder, options, scratch);
  const auto film = scratch / ("film" + extension);
  std::vector<std::string> arguments{"-framerate", fmt::format("{}", options.frames_per_s), "-i",
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
  files::write_atomically(out, files::read_text(film).value_or(""));
  return count;
}

}  // namespace strandlab::run
