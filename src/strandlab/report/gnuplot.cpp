#include "strandlab/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>

#include "strandlab/core/error.hpp"
#include "strandlab/files/atomic_file.hpp"
#include "strandlab/report/colour_map.hpp"

namespace strandlab::report {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c != '\n') out += c;
  }
  out += '"';
  return out;
}

std::string colour(std::size_t curve, std::size_t count) {
  // The very light end of the map is lost on white paper.
  const double t = count < 2 ? 0.75 : 1 - 0.88 * static_cast<double>(curve) / static_cast<double>(count - 1);
  const Colour c = sequential(t);
  const auto byte = [](double share) { return static_cast<int>(std::lround(255 * share)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue));
}

std::string style_of(CurveStyle style, std::size_t curve, double point_size) {
  constexpr std::array kPoints{7, 5, 9, 11, 13, 6, 4, 8};  // gnuplot's filled, then open symbols
  switch (style) {
    case CurveStyle::kLines:
      return "with lines";
    case CurveStyle::kSteps:
      return "with fsteps";
    case CurveStyle::kLinesAndPoints:
      break;
  }
  return fmt::format("with linespoints pt {} ps {}", kPoints[curve % kPoints.size()], point_size);
}

// `dashes` counts the names of references.
std::string reference_style(const Curve& reference, std::size_t dashes, double point_size) {
  constexpr std::array kDashes{2, 4, 3, 5};  // gnuplot's dash types from long dashes to dots and dashes
  if (reference.x.size() == 1) return fmt::format("with points pt {} ps {} lw 2", 1 + dashes % 2, point_size * 4 / 3);
  return fmt::format("with lines dt {} lw 2", kDashes[dashes % kDashes.size()]);
}

std::string data_block(const Curve& curve, const std::string& name) {
  std::string block = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) block += fmt::format("{} {}\n", curve.x[i], curve.y[i]);
  }
  return block + "END\n";
}

std::string data_block(const Band& band, const std::string& name) {
  std::string block = fmt::format("${} << END\n", name);
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    if (std::isfinite(band.low[i]) && std::isfinite(band.high[i]))
      block += fmt::format("{} {} {}\n", band.x[i], band.low[i], band.high[i]);
  }
  return block + "END\n";
}

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw RunError("cannot make a pipe to gnuplot: " + std::generic_category().message(errno));
    }
  }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close(std::size_t end) {
    if (ends_[end] >= 0) ::close(ends_[end]);
    ends_[end] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

struct Finished {
  int status = 0;  // of waitpid; -1 when the program could not be started
  bool in_time = true;
  std::string out, messages;
};

using Clock = std::chrono::steady_clock;

// Milliseconds to a moment, 0 where it has passed.
int left_ms(Clock::time_point end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 1 << 30));
}

// Everything that comes out of both pipes until they close. Returns whether they did so before `end`.
bool drain(Pipe& out, Pipe& messages, Clock::time_point end, Finished& finished) {
  std::array<pollfd, 2> ends{pollfd{out.read_end(), POLLIN, 0}, pollfd{messages.read_end(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&finished.out, &finished.messages};
  std::array<char, 1U << 16U> buffer{};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    const int ready = ::poll(ends.data(), ends.size(), left_ms(end));
    if (ready == 0) return false;
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) return true;
    for (std::size_t e = 0; e < 2; ++e) {
      if (ends[e].fd < 0 || ends[e].revents == 0) continue;
      const ssize_t n = ::read(ends[e].fd, buffer.data(), buffer.size());
      if (n > 0) texts[e]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) ends[e].fd = -1;
    }
  }
  return true;
}

// Waits for a program that has closed its output. Returns whether it ended before `end`.
bool wait_until(pid_t child, Clock::time_point end, int& status) {
  while (true) {
    const pid_t done = ::waitpid(child, &status, WNOHANG);
    if (done == child || (done < 0 && errno != EINTR)) return true;
    if (left_ms(end) == 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

// The PNG at the beginning of what gnuplot prints; empty where there is none, or only the begin of one.
std::string_view png_at_begin(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr auto kSignature = "\x89PNG\r\n\x1a\n"sv;
  constexpr std::size_t kLength = 4, kName = 4, kChecksum = 4;  // bytes of a chunk around its data
  if (bytes.substr(0, kSignature.size()) != kSignature) return {};
  std::size_t end = kSignature.size();
  for (bool last = false; !last;) {
    if (bytes.size() < end + kLength + kName + kChecksum) return {};
    std::size_t length = 0;  // of its data, the highest byte first
    for (const char byte : bytes.substr(end, kLength)) length = 256 * length + static_cast<unsigned char>(byte);
    last = bytes.substr(end + kLength, kName) == "IEND";
    end += kLength + kName + length + kChecksum;
    if (bytes.size() < end) return {};
  }
  return bytes.substr(0, end);
}

// A whole picture of text, from its first to its last words, before `end`.
std::string_view between(std::string_view bytes, std::string_view first, std::string_view last) {
  if (bytes.substr(0, first.size()) != first) return {};
  const auto at = bytes.rfind(last);
  return at == std::string_view::npos ? std::string_view() : bytes.substr(0, at + last.size());
}

// The picture that a script printed: PNG, PDF or SVG; empty where it is not whole.
std::string_view picture_in(std::string_view bytes) {
  if (const auto pdf = between(bytes, "%PDF", "%%EOF\n"); !pdf.empty()) return pdf;
  if (const auto svg = between(bytes, "<?xml", "</svg>"); !svg.empty()) return svg;
  return png_at_begin(bytes);
}

// gnuplot goes on behind a mistake: what it prints after each script tells whose a picture is.
constexpr std::string_view kMark = "-- end of a picture of strandlab --\n";

// One program: each script starts from gnuplot's own settings.
std::string joined(const std::vector<Script>& scripts) {
  std::string text;
  for (const auto& script : scripts) {
    text += text.empty() ? "" : "reset\n";
    text += script.text;
    text += fmt::format("\nset print \"-\"\nprint \"{}\"\n", kMark.substr(0, kMark.size() - 1));
  }
  return text;
}

// What each script printed, empty where that is no whole picture.
std::vector<std::string_view> pictures_of(std::size_t scripts, std::string_view out) {
  std::vector<std::string_view> pictures;
  while (pictures.size() < scripts) {
    const auto mark = out.find(kMark);
    pictures.push_back(picture_in(out.substr(0, mark)));
    out.remove_prefix(mark == std::string_view::npos ? out.size() : mark + kMark.size());
  }
  return pictures;
}

// ---- Settings -------------------------------------------------------------------------------------------------------

constexpr double kScreenPoints = 1.5;  // size of the points, in the terminal's own measure

double point_size(PaperFormat format) {
  switch (format) {
    case PaperFormat::kPdf:
      return .45;
    case PaperFormat::kSvg:
      return .4;
    case PaperFormat::kPng:
      return kScreenPoints;
  }
  __builtin_unreachable();
}

// What the page of a screen is set like.
std::string screen_settings(const Plot& plot) {
  std::string script = fmt::format(
      "set encoding utf8\nset terminal pngcairo noenhanced size 1400,900 font \"sans,20\" background \"#ffffff\"\n"
      "set title {}\n",
      quoted(plot.title));
  return script;
}

std::string screen_key(const Plot& plot) {
  return fmt::format("set key outside right top vertical title {} left Left reverse samplen 2\n",
                     quoted(plot.key_title));
}

// Lines as thin as journals want them; letters of the size asked for.
std::string paper_settings(const Paper& paper) {
  constexpr double kHeight = .8;  // over the width
  const double mm = paper.width_mm;
  std::string terminal;
  switch (paper.format) {
    case PaperFormat::kPdf:
      terminal = fmt::format("pdfcairo noenhanced size {}cm,{}cm font \"{},{}\" fontscale .72 linewidth .4", mm / 10,
                             kHeight * mm / 10, paper.font, paper.font_pt);
      break;
    case PaperFormat::kSvg: {
      constexpr double kPixelsPerInch = 96;  // CSS
      const double px = kPixelsPerInch / 25.4;
      terminal = fmt::format("svg noenhanced size {:.0f},{:.0f} font \"{},{:.1f}\" linewidth .5 background \"#ffffff\"",
                             mm * px, kHeight * mm * px, paper.font, paper.font_pt * kPixelsPerInch / 72);
      break;
    }
    case PaperFormat::kPng: {
      const double px = kPaperDpi / 25.4;
      terminal = fmt::format("pngcairo noenhanced size {:.0f},{:.0f} font \"{},{:.1f}\" background \"#ffffff\"",
                             mm * px, kHeight * mm * px, paper.font, paper.font_pt * kPaperDpi / 96);
      break;
    }
  }
  return fmt::format("set encoding utf8\nset terminal {}\nunset title\n", terminal);
}

// gnuplot takes letters of SVG for wider than they are.
std::string paper_key(const Plot& plot, PaperFormat format) {
  return fmt::format("set key outside top center horizontal maxrows 3 title {} Left reverse samplen 2{}\n",
                     quoted(plot.key_title), format == PaperFormat::kSvg ? " width -6" : "");
}

// The script as a file in memory, at its start: nothing is left of it, and no other run can take it for its own.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) : fd_(::memfd_create("gnuplot script", MFD_CLOEXEC)) {
    std::string_view left = text;
    while (fd_ >= 0 && !left.empty()) {
      const ssize_t n = ::write(fd_, left.data(), left.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) break;
      left.remove_prefix(static_cast<std::size_t>(n));
    }
    if (fd_ < 0 || !left.empty() || ::lseek(fd_, 0, SEEK_SET) != 0)
      throw RunError("cannot keep a gnuplot script in memory: " + std::generic_category().message(errno));
  }
  ~ScriptFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  int descriptor() const { return fd_; }

 private:
  int fd_;
};

// Runs a program with a script as its standard input and collects what it prints. It has a process group of its own, so
// that what it has started ends with it.
Finished run(const Gnuplot& gnuplot, const std::string& script) {
  const ScriptFile input(script);
  Pipe out, messages;
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, messages.write_end(), STDERR_FILENO);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::array<char*, 2> arguments{const_cast<char*>(gnuplot.program.c_str()), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, gnuplot.program.c_str(), &actions, &attributes, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  Finished finished;
  if (error != 0) return {-1, true, "", std::generic_category().message(error)};
  out.close(1);
  messages.close(1);
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(gnuplot.limit_s));
  finished.in_time = drain(out, messages, end, finished) && wait_until(child, end, finished.status);
  if (finished.in_time) return finished;
  ::kill(-child, SIGKILL);
  while (::waitpid(child, &finished.status, 0) < 0 && errno == EINTR) {
  }
  return finished;
}

}  // namespace

std::string gnuplot_script(const Plot& plot, const std::optional<Paper>& paper) {
  std::string script = paper ? paper_settings(*paper) : screen_settings(plot);
  script += fmt::format(
      "set xlabel {}\nset ylabel {}\nset border 3 lw 1.5\nset tics nomirror out\n"
      "set grid lt 1 lc rgb \"#e0e0e0\" lw 1\nset xrange [{}:{}]\nset yrange [0:*]\n",
      quoted(plot.x_label), quoted(plot.y_label), plot.x_low, plot.x_high);
  if (plot.curves.size() + plot.references.size() > 1)
    script += paper ? paper_key(plot, paper->format) : screen_key(plot);
  else
    script += "unset key\nset rmargin 4\n";
  const double size = paper ? point_size(paper->format) : kScreenPoints;
  std::string curves;
  for (std::size_t i = 0; i < plot.bands.size(); ++i) {
    if (plot.bands[i].x.empty()) continue;
    script += data_block(plot.bands[i], fmt::format("band{}", i));
    curves +=
        fmt::format("$band{} using 1:2:3 with filledcurves fs transparent solid 0.2 noborder lc rgb \"{}\" notitle", i,
                    colour(i, plot.curves.size()));
    curves += ", ";
  }
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    script += data_block(plot.curves[i], fmt::format("curve{}", i));
    if (i > 0) curves += ", ";
    curves += fmt::format("$curve{} using 1:2 {} lw 3 lc rgb \"{}\" title {}", i, style_of(plot.style, i, size),
                          colour(i, plot.curves.size()), quoted(plot.curves[i].name));
  }
  std::size_t names = 0;
  for (std::size_t i = 0; i < plot.references.size(); ++i) {
    const Curve& reference = plot.references[i];
    if (i > 0 && !reference.name.empty()) ++names;
    script += data_block(reference, fmt::format("reference{}", i));
    curves += fmt::format(", $reference{} using 1:2 {} lc rgb \"#303030\" title {}", i,
                          reference_style(reference, names, size), quoted(reference.name));
  }
  return script + "plot " + curves + "\nset output\n";
}

Drawn draw_scripts(const std::vector<Script>& scripts, const Gnuplot& gnuplot) {
  if (scripts.empty()) return {};
  const Finished finished = run(gnuplot, joined(scripts));
  const auto printed = pictures_of(scripts.size(), finished.out);
  Drawn drawn;
  std::string missing;
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    const auto& file = scripts[i].file;
    if (printed[i].empty()) {
      missing += (missing.empty() ? "" : ", ") + file.string();
    } else {
      files::write_atomically(file, printed[i]);
      drawn.pictures.push_back(file);
    }
  }
  if (missing.empty()) return drawn;
  std::string warning = fmt::format("no picture {}: {} failed: {}", missing, gnuplot.program, finished.messages);
  if (finished.status == -1) {
    warning = fmt::format("no picture {}: cannot start {} ({}); install the package gnuplot-nox to get plots", missing,
                          gnuplot.program, finished.messages);
  } else if (!finished.in_time) {
    warning = fmt::format("no picture {}: {} was not done after {:g} s and was ended", missing, gnuplot.program,
                          gnuplot.limit_s);
  }
  drawn.warnings.push_back(warning);
  return drawn;
}

Drawn draw(const std::vector<Picture>& pictures, const Gnuplot& gnuplot, const std::optional<Paper>& paper) {
  std::vector<std::string> warnings;
  std::vector<Script> scripts;
  for (const auto& [plot, file] : pictures) {
    const auto& curves = plot.curves;
    if (std::all_of(curves.begin(), curves.end(), [](const Curve& curve) { return curve.x.empty(); }))
      warnings.push_back(fmt::format("no picture {}: nothing to plot yet", file.string()));
    else
      scripts.push_back({gnuplot_script(plot, paper), file});
  }
  auto drawn = draw_scripts(scripts, gnuplot);
  drawn.warnings.insert(drawn.warnings.begin(), warnings.begin(), warnings.end());
  return drawn;
}

}  // namespace strandlab::report
