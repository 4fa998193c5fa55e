#include "strandlab/report/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "strandlab/core/atomic_file.hpp"
#include "strandlab/core/error.hpp"
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

std::string style_of(CurveStyle style, std::size_t curve) {
  constexpr std::array kPoints{7, 5, 9, 11, 13, 6, 4, 8};  // gnuplot's filled, then open symbols
  switch (style) {
    case CurveStyle::kLines:
      return "with lines";
    case CurveStyle::kSteps:
      return "with fsteps";
    case CurveStyle::kLinesAndPoints:
      break;
  }
  return fmt::format("with linespoints pt {} ps 1.5", kPoints[curve % kPoints.size()]);
}

// `dashes` counts the names of references.
std::string reference_style(const Curve& reference, std::size_t dashes) {
  constexpr std::array kDashes{2, 4, 3, 5};  // gnuplot's dash types from long dashes to dots and dashes
  if (reference.x.size() == 1) return fmt::format("with points pt {} ps 2 lw 2", 1 + dashes % 2);
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
  std::string out, messages;
};

// Everything that comes out of both pipes until they close.
void drain(Pipe& out, Pipe& messages, Finished& finished) {
  std::array<pollfd, 2> ends{pollfd{out.read_end(), POLLIN, 0}, pollfd{messages.read_end(), POLLIN, 0}};
  const std::array<std::string*, 2> texts{&finished.out, &finished.messages};
  std::array<char, 1U << 16U> buffer{};
  while (ends[0].fd >= 0 || ends[1].fd >= 0) {
    if (::poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t e = 0; e < 2; ++e) {
      if (ends[e].fd < 0 || ends[e].revents == 0) continue;
      const ssize_t n = ::read(ends[e].fd, buffer.data(), buffer.size());
      if (n > 0) texts[e]->append(buffer.data(), static_cast<std::size_t>(n));
      if (n == 0 || (n < 0 && errno != EINTR)) ends[e].fd = -1;
    }
  }
}

// Runs `program` on a script file and collects what it prints.
Finished run(const std::string& program, const std::string& script_file) {
  Pipe out, messages;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, out.write_end(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, messages.write_end(), STDERR_FILENO);
  std::array<char*, 3> arguments{const_cast<char*>(program.c_str()), const_cast<char*>(script_file.c_str()), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  Finished finished;
  if (error != 0) return {-1, "", std::generic_category().message(error)};
  out.close(1);
  messages.close(1);
  drain(out, messages, finished);
  while (::waitpid(child, &finished.status, 0) < 0 && errno == EINTR) {
  }
  return finished;
}

// A script beside the picture, gone with this object.
class ScriptFile {
 public:
  ScriptFile(std::filesystem::path file, const std::string& text) : file_(std::move(file)) {
    write_atomically(file_, text);
  }
  ~ScriptFile() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;
  std::string name() const { return std::filesystem::absolute(file_).string(); }

 private:
  std::filesystem::path file_;
};

}  // namespace

std::string gnuplot_script(const Plot& plot) {
  std::string script = fmt::format(
      "set encoding utf8\nset terminal pngcairo noenhanced size 1400,900 font \"sans,20\" background \"#ffffff\"\n"
      "set title {}\nset xlabel {}\nset ylabel {}\nset border 3 lw 1.5\nset tics nomirror out\n"
      "set grid lt 1 lc rgb \"#e0e0e0\" lw 1\nset xrange [{}:{}]\nset yrange [0:*]\n",
      quoted(plot.title), quoted(plot.x_label), quoted(plot.y_label), plot.x_low, plot.x_high);
  if (plot.curves.size() + plot.references.size() > 1) {
    script += fmt::format("set key outside right top vertical title {} left Left reverse samplen 2\n",
                          quoted(plot.key_title));
  } else {
    script += "unset key\nset rmargin 4\n";
  }
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
    curves += fmt::format("$curve{} using 1:2 {} lw 3 lc rgb \"{}\" title {}", i, style_of(plot.style, i),
                          colour(i, plot.curves.size()), quoted(plot.curves[i].name));
  }
  std::size_t names = 0;
  for (std::size_t i = 0; i < plot.references.size(); ++i) {
    const Curve& reference = plot.references[i];
    if (i > 0 && !reference.name.empty()) ++names;
    script += data_block(reference, fmt::format("reference{}", i));
    curves += fmt::format(", $reference{} using 1:2 {} lc rgb \"#303030\" title {}", i,
                          reference_style(reference, names), quoted(reference.name));
  }
  return script + "plot " + curves + "\n";
}

std::optional<std::string> draw_script(const std::string& script, const std::filesystem::path& png,
                                       const std::string& program) {
  std::filesystem::path beside = png;
  beside.replace_extension(".gnuplot");
  const ScriptFile file(beside, script);
  const Finished gnuplot = run(program, file.name());
  if (gnuplot.status == -1) {
    return fmt::format("no picture {}: cannot start {} ({}); install the package gnuplot-nox to get plots",
                       png.string(), program, gnuplot.messages);
  }
  if (gnuplot.status != 0 || gnuplot.out.empty()) {
    return fmt::format("no picture {}: {} failed: {}", png.string(), program, gnuplot.messages);
  }
  write_atomically(png, gnuplot.out);
  return std::nullopt;
}

std::optional<std::string> draw(const Plot& plot, const std::filesystem::path& png, const std::string& program) {
  bool empty = true;
  for (const auto& curve : plot.curves) empty = empty && curve.x.empty();
  if (empty) return fmt::format("no picture {}: nothing to plot yet", png.string());
  return draw_script(gnuplot_script(plot), png, program);
}

}  // namespace strandlab::report
