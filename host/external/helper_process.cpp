#include "helper_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "swage/error.h"

extern char** environ;

namespace swage {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

[[noreturn]] void refuse_to_start(const std::string& name, int error) {
  throw Unavailable(name + " cannot be started: " + std::strerror(error));
}

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() {
    if (is_open()) ::close(std::exchange(number_, -1));
  }

 private:
  int number_;
};

/// Two ends that are joined both ways. Sockets, as a write to a pipe whose reader is gone raises SIGPIPE.
struct Line {
  Descriptor ours, theirs;
};

/// Above the standard three, which may be closed here and are replaced in the helper.
Descriptor lifted(Descriptor low, const std::string& name) {
  if (low.number() > STDERR_FILENO) return low;
  Descriptor high(fcntl(low.number(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  if (!high.is_open()) refuse_to_start(name, errno);
  return high;
}

Line new_line(const std::string& name) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) refuse_to_start(name, errno);
  Descriptor ours(ends[0]), theirs(ends[1]);
  return {lifted(std::move(ours), name), lifted(std::move(theirs), name)};
}

/// Killed at the end of the scope where it still runs.
class Process {
 public:
  explicit Process(pid_t id) : id_(id) {}
  ~Process() {
    if (status_) return;
    kill(id_, SIGKILL);
    wait(0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// As waitpid gives it, once it has ended.
  std::optional<int> status() {
    if (!status_) wait(WNOHANG);
    return status_;
  }

  /// No more than `most`, nor than the helper is allowed already.
  void limit(__rlimit_resource resource, rlim_t most) const {
    rlimit limit{};
    if (prlimit(id_, resource, nullptr, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max = std::min(limit.rlim_max, most);
    prlimit(id_, resource, &limit, nullptr);
  }

 private:
  void wait(int flags) {
    int status = 0;
    pid_t ended = 0;
    do {
      ended = waitpid(id_, &status, flags);
    } while (ended < 0 && errno == EINTR);
    if (ended == id_) status_ = status;
    // Where the caller ignores SIGCHLD or waits for every child itself, the status is lost.
    if (ended < 0) status_ = 0;
  }

  pid_t id_;
  std::optional<int> status_;
};

/// Signals as a fresh program has them, whatever this one blocks or ignores.
class Attributes {
 public:
  Attributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

/// Spawned, not forked: a forked child of a process that has used OpenCL hangs.
pid_t spawn(const fs::path& path, const std::string& name, int talk, int complaints) {
  const Attributes attributes;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, talk, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, talk, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, complaints, STDERR_FILENO);
  std::string program = path.string();
  char* const arguments[] = {program.data(), nullptr};
  pid_t id = -1;
  const int error = posix_spawn(&id, program.c_str(), &files, attributes.get(), arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) refuse_to_start(name, error);
  return id;
}

/// What has come, appended to `text`. Closes our end where the other is closed.
void receive(Descriptor& end, std::string& text) {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = recv(end.number(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count > 0) text.append(buffer.data(), static_cast<size_t>(count));
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) end.close();
}

std::string last_line(const std::string& text) {
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return {};
  const size_t before = text.find_last_of("\r\n", last);
  return text.substr(before + 1, last - before);  // From 0 where there is none before.
}

class Helper {
 public:
  Helper(const fs::path& path, const HelperLimits& limits, const Poll& poll)
      : name_(path.filename()),
        limits_(limits),
        poll_(poll),
        talk_(new_line(name_)),
        complaints_(new_line(name_)),
        process_(spawn(path, name_, talk_.theirs.number(), complaints_.theirs.number())) {
    talk_.theirs.close();
    complaints_.theirs.close();
    process_.limit(RLIMIT_AS, limits.bytes);
    process_.limit(RLIMIT_CORE, 0);
  }

  std::string answer(const std::string& input) {
    size_t sent = 0;
    while (talk_.ours.is_open() || complaints_.ours.is_open()) {
      check();
      exchange(input, sent);
    }
    check_status(wait());
    return std::move(answer_);
  }

 private:
  void check() {
    ask(poll_);
    if (std::chrono::duration<double>(Clock::now() - start_).count() > limits_.seconds) {
      refuse("did not end within " + std::to_string(std::lround(limits_.seconds)) + " seconds");
    }
    if (answer_.size() > limits_.bytes) refuse("answers with more than it may");
  }

  /// Reads and writes what can be at once, so that neither side waits for the other.
  void exchange(const std::string& input, size_t& sent) {
    static constexpr int kPause = 100;  // Milliseconds.
    const auto wanted = static_cast<short>(sent <= input.size() ? POLLIN | POLLOUT : POLLIN);
    std::array<pollfd, 2> ends{pollfd{talk_.ours.number(), wanted, 0}, pollfd{complaints_.ours.number(), POLLIN, 0}};
    if (::poll(ends.data(), ends.size(), kPause) <= 0) return;
    if ((ends[0].revents & POLLOUT) != 0) send(input, sent);
    if ((ends[0].revents & ~POLLOUT) != 0) receive(talk_.ours, answer_);
    if (ends[1].revents != 0) receive(complaints_.ours, complaint_);
    static constexpr size_t kKept = 1000;
    if (complaint_.size() > 2 * kKept) complaint_.erase(0, complaint_.size() - kKept);
  }

  /// Up to one past the input, its end having been told. A helper may answer without reading all of it.
  void send(const std::string& input, size_t& sent) {
    if (sent < input.size()) {
      const ssize_t count =
          ::send(talk_.ours.number(), input.data() + sent, input.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) sent += static_cast<size_t>(count);
      if (count < 0 && errno != EAGAIN && errno != EINTR) sent = input.size();
    }
    if (sent == input.size()) {
      shutdown(talk_.ours.number(), SHUT_WR);
      ++sent;
    }
  }

  int wait() {
    while (!process_.status()) {
      check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return *process_.status();
  }

  void check_status(int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    ask(poll_);  // Ctrl-C ends both: the caller's word counts.
    if (WIFSIGNALED(status)) {
      const int number = WTERMSIG(status);
      refuse("was ended by signal " + std::to_string(number) + " (" + strsignal(number) + ")");
    }
    refuse("failed with status " + std::to_string(WEXITSTATUS(status)));
  }

  [[noreturn]] void refuse(const std::string& how) const {
    const std::string line = last_line(complaint_);
    throw Unsolvable(name_ + " " + how + (line.empty() ? "" : ": " + line));
  }

  std::string name_;
  HelperLimits limits_;
  const Poll& poll_;
  Clock::time_point start_ = Clock::now();
  Line talk_, complaints_;
  Process process_;
  std::string answer_, complaint_;
};

fs::path find_helper(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  std::string places;
  for (const fs::path& folder : helper_folders()) {
    if (access((folder / program).c_str(), X_OK) == 0) return folder / program;
    places += (places.empty() ? "" : ", ") + folder.string();
  }
  throw Unavailable(program + " is in none of " + places + "; name its folder in the environment's SWAGE_HELPERS");
}

}  // namespace

std::string run_helper(const std::string& program, const std::string& input, const HelperLimits& limits,
                       const Poll& poll) {
  return Helper(find_helper(program), limits, poll).answer(input);
}

}  // namespace swage
