#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw UnwritableFile(path.string() + ": cannot be written: " + why);
}

[[noreturn]] void refuse_errno(const fs::path& path, int error) {
  refuse(path, std::string(std::strerror(error)) + "; check the folder, its permissions and the room left");
}

// Closes at the end of the scope; close() tells whether that went well.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool close() {
    const int number = number_;
    number_ = -1;
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

bool write_all(int descriptor, const std::string& content) {
  size_t written = 0;
  while (written < content.size()) {
    const ssize_t step = ::write(descriptor, content.data() + written, content.size() - written);
    if (step < 0 && errno == EINTR) continue;
    if (step <= 0) return false;
    written += static_cast<size_t>(step);
  }
  return true;
}

// Where symbolic links lead, though the last may lead to nothing yet.
fs::path destination(fs::path path) {
  constexpr int kMostLinks = 40;
  for (int links = 0; fs::is_symlink(fs::symlink_status(path)); ++links) {
    if (links == kMostLinks) refuse(path, "too many symbolic links; name the file itself");
    path = path.parent_path() / fs::read_symlink(path);
  }
  return path;
}

void write_directly(const fs::path& path, const std::string& content) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0 || !write_all(file.number(), content) || !file.close()) refuse_errno(path, errno);
}

// What is in memory only is not yet in the place of what it replaces. Some file systems cannot tell.
bool reaches_disk(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP; }

// A new file beside `path`, gone at the end of the scope unless it took the place of `path`. It has no name until it is
// whole where the file system knows such files: then whatever ends the program leaves nothing behind.
class Temporary {
 public:
  Temporary(const fs::path& target, const struct stat* replaced)
      : target_(target), replaces_(replaced != nullptr), file_(open()) {
    if (replaced == nullptr) return;
    // Where it may be given away, to root that is, the owner stays; else it is whoever writes.
    [[maybe_unused]] const int given = ::fchown(file_.number(), replaced->st_uid, replaced->st_gid);
    if (::fchmod(file_.number(), replaced->st_mode & 07777) != 0) fail();
  }
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(const std::string& content) {
    if (!write_all(file_.number(), content)) fail();
    if (replaces_ && !reaches_disk(file_.number())) fail();
  }

  void rename() {
    if (name_.empty()) {
      const std::string unnamed = link_to(file_.number());
      give_name([&](const char* name) {
        return ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
      });
    }
    if (!file_.close() || ::rename(name_.c_str(), target_.c_str()) != 0) fail();
    name_.clear();
  }

 private:
  static std::string link_to(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

  // As any file is opened, so that the umask gives its permissions.
  int open() {
    int number = -1;
#ifdef O_TMPFILE
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : ".";
    number = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
    if (number >= 0 && ::access(link_to(number).c_str(), F_OK) == 0) return number;
    if (number >= 0) ::close(number);
#endif
    give_name([&](const char* name) {
      number = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      return number >= 0;
    });
    return number;
  }

  // Calls take(name) with names until it has one that nothing else has.
  template <typename Take>
  void give_name(const Take& take) {
    constexpr int kTries = 100;
    std::random_device random;
    for (int k = 0; k < kTries; ++k) {
      fs::path name = target_.parent_path() / (".swage-" + std::to_string(random()) + ".tmp");
      if (take(name.c_str())) {
        name_ = std::move(name);
        return;
      }
      if (errno != EEXIST) break;
    }
    refuse_errno(target_, errno);
  }

  // The destructor does not run where the constructor throws.
  [[noreturn]] void fail() {
    const int error = errno;
    if (!name_.empty()) ::unlink(name_.c_str());
    name_.clear();
    refuse_errno(target_, error);
  }

  fs::path target_;
  bool replaces_;
  fs::path name_;
  Descriptor file_;
};

void write_beside(const fs::path& path, const std::string& content, const struct stat* replaced) {
  Temporary temporary(path, replaced);
  temporary.write(content);
  temporary.rename();
}

void write_to(const fs::path& path, const std::string& content) {
  struct stat present;
  if (::stat(path.c_str(), &present) != 0) {
    if (errno != ENOENT) refuse_errno(path, errno);
    return write_beside(path, content, nullptr);
  }
  if (S_ISDIR(present.st_mode)) refuse(path, "it is a folder; name a file in it");
  if (!S_ISREG(present.st_mode)) return write_directly(path, content);
  if (::access(path.c_str(), W_OK) != 0) refuse(path, "it is read-only; change its permissions or the name");
  write_beside(path, content, &present);
}

}  // namespace

void write_file(const fs::path& path, const std::string& content) {
  fs::path target = path;
  try {
    target = destination(path);
    write_to(target, content);
  } catch (const fs::filesystem_error& error) {
    refuse(path, error.code().message() + "; check the folder and its permissions");
  } catch (const UnwritableFile& error) {
    if (target == path) throw;
    throw UnwritableFile(path.string() + ", a link: " + error.what());
  }
}

}  // namespace swage
