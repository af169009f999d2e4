#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <stdexcept>

extern char** environ;

namespace swage::test {
namespace {

constexpr int kMinute = 60000;  // Milliseconds.

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Of the names that stand twice, the first counts.
std::vector<std::string> with_ours(const std::vector<std::string>& extra) {
  std::vector<std::string> all = extra;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!std::string(*entry).starts_with("SWAGE_")) all.emplace_back(*entry);
  }
  return all;
}

}  // namespace

int Running::wait() const {
  int status = 0;
  if (waitpid(process, &status, 0) != process) throw std::runtime_error("no such process");
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Running start(const Arguments& arguments, const std::filesystem::path& out, const std::filesystem::path& err,
              const std::vector<std::string>& environment) {
  std::vector<std::string> texts{SWAGE_PROGRAM}, variables = with_ours(environment);
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0600);
  Running running;
  const int error =
      posix_spawn(&running.process, SWAGE_PROGRAM, &files, nullptr, pointers(texts).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("the program did not start");
  return running;
}

Outcome run(const Arguments& arguments, const std::vector<std::string>& environment) {
  const TempFolder folder;
  Outcome outcome;
  outcome.code = start(arguments, folder / "out", folder / "err", environment).wait();
  outcome.out = read_text(folder / "out");
  outcome.err = read_text(folder / "err");
  return outcome;
}

bool Terminal::exists() {
  const int end = posix_openpt(O_RDWR | O_NOCTTY);
  if (end >= 0) close(end);
  return end >= 0;
}

Terminal::Terminal() : end_(posix_openpt(O_RDWR | O_NOCTTY)) {
  if (end_ < 0 || grantpt(end_) != 0 || unlockpt(end_) != 0) throw std::runtime_error("no pseudo-terminal");
}

Terminal::~Terminal() { close(end_); }

std::filesystem::path Terminal::path() const { return ptsname(end_); }

bool Terminal::read_some() {
  pollfd waiting{end_, POLLIN, 0};
  if (poll(&waiting, 1, kMinute) <= 0) return false;
  std::array<char, 4096> buffer{};
  const ssize_t count = read(end_, buffer.data(), buffer.size());
  if (count <= 0) return false;
  text_.append(buffer.data(), static_cast<size_t>(count));
  return true;
}

bool Terminal::wait_for(const std::string& text) {
  while (text_.find(text) == std::string::npos) {
    if (!read_some()) return false;
  }
  return true;
}

std::string Terminal::rest() {
  while (read_some()) {
  }
  return text_;
}

std::string box_obj(int cells) {
  std::map<std::array<int, 3>, int> ids;
  std::ostringstream vertices, faces;
  auto id = [&](const std::array<int, 3>& at) {
    const auto [found, fresh] = ids.try_emplace(at, static_cast<int>(ids.size()) + 1);
    const double size = cells;
    if (fresh) vertices << "v " << at[0] / size << ' ' << at[1] / size << ' ' << 2 * at[2] / size << '\n';
    return found->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      const std::string normal = std::to_string(1 + 2 * axis + static_cast<size_t>(side));
      faces << "g side" << normal << "\nusemtl paint" << side << '\n';
      for (int i = 0; i < cells * cells; ++i) {
        std::array<std::array<int, 3>, 4> quad{};
        for (size_t k = 0; k < 4; ++k) {
          quad[k][axis] = side * cells;
          quad[k][(axis + 1) % 3] = i % cells + (k == 1 || k == 2 ? 1 : 0);
          quad[k][(axis + 2) % 3] = i / cells + (k >= 2 ? 1 : 0);
        }
        if (side == 0) std::swap(quad[1], quad[3]);
        faces << 'f';
        for (const auto& corner : quad) faces << ' ' << id(corner) << "/1/" << normal;
        faces << '\n';
      }
    }
  }
  return "# a box, for a test\r\nmtllib box.mtl\no box\n" + vertices.str() +
         "vt 0.50 0.250\nvn -1 0 0\nvn 1 0 0\nvn 0 -1 0\nvn 0 1 0\nvn 0 0 -1\nvn 0 0 1\ns off\n" + faces.str();
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> result;
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace swage::test
